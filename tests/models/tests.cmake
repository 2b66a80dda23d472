incognita_test(
  models_test
  SOURCES models/camera_laws_test.cpp models/motion_laws_test.cpp models/planar_measurement_laws_test.cpp
          models/landmark_laws_test.cpp models/free_camera_test.cpp models/planar_frame_test.cpp
          models/planar_vehicle_test.cpp models/planar_twist_test.cpp models/range_bearing_test.cpp models/bearing_test.cpp
          models/stereo_camera_test.cpp models/terrain_test.cpp models/terrain_vehicle_test.cpp models/mount_test.cpp models/any_sensor_test.cpp
          models/any_sensor_initialization_test.cpp models/registry_test.cpp models/stereo_inverse_depth_test.cpp models/height_map_test.cpp models/wheel_odometry_test.cpp
  USES incognita::models)
