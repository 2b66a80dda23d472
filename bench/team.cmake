incognita_bench(team_bench SOURCES team_bench.cpp USES incognita::slam incognita::world)
