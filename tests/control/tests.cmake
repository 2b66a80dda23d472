incognita_test(control_test SOURCES control/controller_test.cpp control/manual_control_test.cpp control/velocity_limits_test.cpp USES incognita::control)
incognita_test(steering_test
               SOURCES control/car_linearization_test.cpp control/feedback_linearization_test.cpp
                       control/lqg_regulator_test.cpp control/lqr_test.cpp control/path_acceleration_test.cpp
                       control/reference_path_test.cpp
               USES incognita::steering)
incognita_test(steering_laws_test SOURCES control/steering_laws_test.cpp USES incognita::steering incognita::world)
incognita_test(keep_clear_test SOURCES control/obstacle_avoidance_test.cpp control/body_controller_test.cpp USES incognita::control incognita::world)
