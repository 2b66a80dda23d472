incognita_test(world_test SOURCES world/ground_test.cpp world/operator_model_test.cpp world/room_bodies_test.cpp world/replay_test.cpp world/live_source_test.cpp world/room_test.cpp world/room_vehicle_test.cpp world/render_test.cpp world/sensor_test.cpp world/disturbances_test.cpp
                       world/motion_spline_test.cpp world/exposure_test.cpp world/surface_patches_test.cpp world/place_motion_test.cpp world/live_feed_test.cpp
               USES incognita::world incognita::steering opencv_core opencv_imgproc)
incognita_test(point_world_test SOURCES world/simulated_world_test.cpp world/motion_plant_test.cpp world/point_world_test.cpp USES incognita::world)
