incognita_test(analysis_test
               SOURCES analysis/closed_loop_test.cpp analysis/expression_guard_test.cpp analysis/linear_system_test.cpp analysis/map_error_test.cpp analysis/mapped_share_test.cpp
                       analysis/null_space_test.cpp analysis/run_consistency_test.cpp analysis/statistics_test.cpp analysis/trajectory_test.cpp analysis/pose_consistency_test.cpp
               USES incognita::analysis)
incognita_test(observability_monitor_test SOURCES analysis/observability_monitor_test.cpp analysis/saved_monitor_test.cpp analysis/observability_report_test.cpp
                                                 analysis/row_sum_test.cpp analysis/symmetries_test.cpp
               USES incognita::analysis)
incognita_test(systems_test SOURCES analysis/assigned_input_test.cpp analysis/expression_graph_test.cpp
                                    analysis/observability_test.cpp analysis/thesis_ranks_test.cpp
               USES incognita::systems incognita::io)
target_link_libraries(systems_test PRIVATE PkgConfig::GINAC)  # the headers of a system's symbols
