incognita_room(models
  SOURCES models/any_motion.cpp models/any_sensor.cpp models/camera_look.cpp models/heading.cpp
          models/stereo_camera.cpp models/terrain.cpp models/terrain_vehicle.cpp
  USES incognita::math)
