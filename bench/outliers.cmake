# Trials, not a benchmark of Google Benchmark: it prints a table
add_executable(outlier_trials outlier_trials.cpp)
target_link_libraries(outlier_trials PRIVATE incognita::slam)
