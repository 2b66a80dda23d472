incognita_test(analysis_test SOURCES analysis/linear_system_test.cpp analysis/map_error_test.cpp analysis/trajectory_test.cpp analysis/pose_consistency_test.cpp
               USES incognita::analysis)
