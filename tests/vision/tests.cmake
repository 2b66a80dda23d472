incognita_test(vision_test SOURCES vision/align_patch_test.cpp vision/search_test.cpp vision/patch_test.cpp vision/pyramid_test.cpp vision/corners_test.cpp vision/descriptor_test.cpp
               USES incognita::vision incognita::math)
incognita_test(camera_calibration_test SOURCES vision/calibration_test.cpp
               USES incognita::calibration incognita::models incognita::io)
incognita_test(live_calibration_test SOURCES vision/live_calibration_test.cpp
               USES incognita::calibration incognita::models)
