incognita_room(decision SOURCES decision/actions.cpp decision/camera_decision.cpp decision/information.cpp
               USES incognita::slam)
