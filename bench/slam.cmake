incognita_bench(slam_bench SOURCES slam_bench.cpp USES incognita::app)
