find_package(Boost 1.74 REQUIRED)
incognita_module(world FOLDERS world world/rendered world/replay world/points world/robot
                 USES incognita::models incognita::messages PRIVATE_USES Boost::headers)
