incognita_test(math_test SOURCES math/angles_test.cpp math/chart_test.cpp math/quaternion_test.cpp
               math/random_test.cpp math/saved_state_test.cpp math/time_stamp_test.cpp USES incognita::math)
