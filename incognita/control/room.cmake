# Laws that need a model or its matrices, and no estimator: a target of its own, so that who wants a regulator pulls no
# vision
find_package(Boost 1.74 REQUIRED)  # headers only: the greatest speed of a path
incognita_room(steering
  SOURCES control/lqr.cpp
  USES incognita::models incognita::analysis PRIVATE_USES Boost::headers)
incognita_room(control SOURCES control/camera_controller.cpp control/reference.cpp
               USES incognita::slam incognita::steering)
