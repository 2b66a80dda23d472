incognita_room(decision
  SOURCES decision/action_choice.cpp decision/actions.cpp decision/camera_decision.cpp decision/camera_expectation.cpp
          decision/expectation.cpp decision/exploration.cpp decision/extended_entropy.cpp decision/free_camera_choice.cpp decision/ground_moves.cpp decision/information_gain.cpp
          decision/look_ahead.cpp decision/moves.cpp decision/team_decision.cpp decision/team_expectation.cpp decision/vehicle_choice.cpp
  USES incognita::slam)
