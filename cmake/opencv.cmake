# Imported targets opencv_core, opencv_imgproc, ... for just the parts of OpenCV that are installed. Debian keeps
# OpenCVConfig.cmake in libopencv-dev, which pulls in every module and GDAL, VTK and Qt with them; the parts' own
# packages (libopencv-core-dev, ...) leave those out.
find_path(OPENCV_INCLUDE_DIR opencv2/core.hpp PATH_SUFFIXES opencv4)
foreach(part core imgproc imgcodecs calib3d videoio)
  find_library(OPENCV_${part}_LIBRARY opencv_${part})
  if(OPENCV_INCLUDE_DIR AND OPENCV_${part}_LIBRARY AND NOT TARGET opencv_${part})
    add_library(opencv_${part} UNKNOWN IMPORTED GLOBAL)
    set_target_properties(opencv_${part} PROPERTIES IMPORTED_LOCATION ${OPENCV_${part}_LIBRARY}
                          INTERFACE_INCLUDE_DIRECTORIES ${OPENCV_INCLUDE_DIR})
  elseif(NOT TARGET opencv_${part})
    message(FATAL_ERROR "OpenCV's ${part} is missing; on Debian: apt-get install libopencv-${part}-dev")
  endif()
endforeach()
