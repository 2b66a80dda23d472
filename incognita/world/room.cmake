find_package(Boost 1.74 REQUIRED)
incognita_room(world
  SOURCES world/canvas.cpp world/carried_camera_world.cpp world/decor.cpp world/floor_plan.cpp world/free_camera_plant.cpp world/ground.cpp world/image_noise.cpp world/integrate.cpp world/operator_model.cpp world/planar_loop.cpp
          world/print.cpp world/range_replay.cpp world/ray_table.cpp world/render.cpp world/room.cpp
          world/plant.cpp world/room_camera.cpp world/room_clock.cpp world/room_layout.cpp world/room_vehicle.cpp world/team_replay.cpp world/team_world.cpp world/texture.cpp
  USES incognita::models incognita::messages PRIVATE_USES Boost::headers)
