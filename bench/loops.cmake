# Trials, not a benchmark of Google Benchmark: it prints a line for each room
find_package(CLI11 REQUIRED)
add_executable(loop_trials loop_trials.cpp)
target_link_libraries(loop_trials PRIVATE incognita::app CLI11::CLI11)
