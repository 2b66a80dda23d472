incognita_test(planar_consistency_test SOURCES experiments/planar_consistency_test.cpp USES incognita::experiments incognita::app)
incognita_test(monobot_test SOURCES experiments/evidence_test.cpp experiments/monobot_test.cpp USES incognita::experiments)
incognita_test(claims_test SOURCES experiments/claims_test.cpp USES incognita::experiments)
