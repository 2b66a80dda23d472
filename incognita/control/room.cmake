# Laws that need a model or its matrices, and no estimator: a target of its own, so that who wants a regulator pulls no
# vision
find_package(Boost 1.74 REQUIRED)  # headers only: the greatest speed of a path
incognita_room(steering
  SOURCES control/car_linearisation.cpp control/feedback_linearisation.cpp control/fly_segment.cpp control/held_command.cpp control/keep_clear.cpp
          control/lqg_regulator.cpp control/lqr.cpp control/path_speed.cpp control/planar_tracking.cpp
          control/pose_spline.cpp
          control/reference.cpp control/reference_path.cpp control/steering.cpp control/steering_fault.cpp control/track_reference.cpp
  USES incognita::models incognita::messages incognita::analysis PRIVATE_USES Boost::headers)
incognita_room(control SOURCES control/camera_controller.cpp control/team_controller.cpp control/vehicle_controller.cpp USES incognita::slam incognita::steering)
