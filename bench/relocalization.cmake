# Trials, not a benchmark of Google Benchmark: it prints a line for each
add_executable(relocalization_trials relocalization_trials.cpp)
target_link_libraries(relocalization_trials PRIVATE incognita::app)
