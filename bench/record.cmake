incognita_bench(record_bench SOURCES record_bench.cpp USES incognita::record)
