incognita_bench(range_bearing_bench SOURCES range_bearing_bench.cpp USES incognita::belief incognita::models)
