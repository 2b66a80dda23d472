incognita_test(control_test SOURCES control/controller_test.cpp USES incognita::control)
