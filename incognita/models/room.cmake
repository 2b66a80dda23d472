incognita_room(models SOURCES models/camera_look.cpp models/heading.cpp models/stereo_camera.cpp USES incognita::math)
