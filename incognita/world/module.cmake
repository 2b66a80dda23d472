find_package(Boost 1.74 REQUIRED)
incognita_module(world FOLDERS world world/rendered world/replay world/live world/points
                 USES incognita::models incognita::messages PRIVATE_USES Boost::headers)
