find_package(Boost 1.74 REQUIRED)  # headers only: quantiles of chi-square
incognita_room(math SOURCES math/chart.cpp math/gaussian.cpp math/nearest_name.cpp math/quaternion.cpp math/random.cpp
                    math/time_stamp.cpp
               USES Eigen3::Eigen PRIVATE_USES Boost::headers)
