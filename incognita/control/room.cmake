incognita_room(control SOURCES control/camera_controller.cpp control/reference.cpp USES incognita::slam)
