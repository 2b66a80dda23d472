incognita_test(decision_test
  SOURCES decision/actions_test.cpp decision/image_expectation_test.cpp decision/exploration_test.cpp decision/extended_entropy_test.cpp decision/information_gain_test.cpp
          decision/look_ahead_test.cpp decision/action_sets_test.cpp decision/decision_test.cpp decision/carrier_choice_test.cpp decision/taken_over_test.cpp decision/baselines_test.cpp decision/plan_test.cpp decision/side_cells_test.cpp
  USES incognita::decision)
