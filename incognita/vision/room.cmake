incognita_room(vision SOURCES vision/corners.cpp vision/patch.cpp vision/search.cpp
               USES incognita::math PRIVATE_USES opencv_core opencv_imgproc)
