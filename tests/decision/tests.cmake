incognita_test(decision_test SOURCES decision/information_test.cpp decision/actions_test.cpp
               USES incognita::decision)
