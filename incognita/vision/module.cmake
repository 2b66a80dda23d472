incognita_module(vision FOLDERS vision USES incognita::math PRIVATE_USES opencv_core opencv_imgproc)
