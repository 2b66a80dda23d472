incognita_test(planar_consistency_test SOURCES experiments/planar_consistency_test.cpp USES incognita::experiments incognita::app)
