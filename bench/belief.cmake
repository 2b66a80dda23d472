incognita_bench(belief_bench SOURCES belief_bench.cpp USES incognita::belief)
