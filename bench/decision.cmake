incognita_bench(decision_bench SOURCES decision_bench.cpp USES incognita::app)
