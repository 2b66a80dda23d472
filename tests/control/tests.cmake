incognita_test(control_test SOURCES control/controller_test.cpp USES incognita::control)
incognita_test(steering_test
               SOURCES control/lqr_test.cpp
               USES incognita::steering)
