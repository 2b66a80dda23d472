if(NOT fmt_FOUND)
  find_package(fmt REQUIRED)
endif()
incognita_module(vision FOLDERS vision USES incognita::math PRIVATE_USES opencv_core opencv_imgproc)
# Separate, since nothing else needs OpenCV's calibration
incognita_module(calibration FOLDERS vision/calibration USES incognita::vision
                 PRIVATE_USES fmt::fmt opencv_core opencv_imgproc opencv_calib3d)
