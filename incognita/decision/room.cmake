incognita_room(decision SOURCES decision/actions.cpp decision/camera_decision.cpp decision/information.cpp decision/team_decision.cpp
               USES incognita::slam)
