incognita_module(slam FOLDERS slam/mapper slam/points slam/bundle slam/features slam/estimator
                 USES incognita::belief incognita::models incognita::messages incognita::vision
                 PRIVATE_USES opencv_calib3d opencv_core)
