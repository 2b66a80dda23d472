# Trials, not a benchmark of Google Benchmark: it prints the errors of one run
add_executable(adjusted_trajectory adjusted_trajectory.cpp)
target_link_libraries(adjusted_trajectory PRIVATE incognita::app)
