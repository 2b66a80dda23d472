find_package(Boost 1.74 REQUIRED)  # headers only: quantiles of chi-square
incognita_module(math FOLDERS math math/saved_state USES Eigen3::Eigen PRIVATE_USES Boost::headers)
