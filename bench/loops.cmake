# Trials, not a benchmark of Google Benchmark: it prints a line for each room
add_executable(loop_trials loop_trials.cpp)
target_link_libraries(loop_trials PRIVATE incognita::app)
