incognita_room(models SOURCES models/camera_look.cpp models/heading.cpp USES incognita::math)
