# Laws that need a model or its matrices and no estimator are a target of their own, so that a regulator links no vision
find_package(Boost 1.74 REQUIRED)  # headers only: the greatest speed of a path
set(of_estimates control/steering_controller.cpp)
incognita_module(steering FOLDERS control control/paths WITHOUT ${of_estimates}
                 USES incognita::models incognita::messages incognita::analysis PRIVATE_USES Boost::headers)
incognita_module(control SOURCES ${of_estimates} USES incognita::slam incognita::steering)
