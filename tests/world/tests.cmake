incognita_test(world_test SOURCES world/ground_test.cpp world/operator_model_test.cpp world/plant_test.cpp world/range_replay_test.cpp world/room_test.cpp world/room_vehicle_test.cpp world/render_test.cpp world/sensor_test.cpp
               USES incognita::world incognita::steering opencv_core opencv_imgproc)
incognita_test(team_world_test SOURCES world/carried_camera_world_test.cpp world/motion_plant_test.cpp world/team_world_test.cpp USES incognita::world)
