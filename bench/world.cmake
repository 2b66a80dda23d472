incognita_bench(world_bench SOURCES world_bench.cpp USES incognita::world)
