incognita_room(models SOURCES models/camera_look.cpp USES incognita::math)
