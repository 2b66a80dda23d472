incognita_test(pinhole_test SOURCES models/pinhole_test.cpp models/fisheye_test.cpp USES incognita::models opencv_core opencv_calib3d)
incognita_test(settings_test SOURCES io/settings_test.cpp io/camera_file_test.cpp io/decision_checks_test.cpp io/enum_words_test.cpp USES incognita::io)
incognita_test(recording_test SOURCES io/euroc_camera_test.cpp io/recording_test.cpp USES incognita::io incognita::world opencv_core opencv_imgcodecs)
incognita_test(video_test SOURCES io/network_stream_test.cpp io/video_test.cpp io/video_stream_test.cpp io/true_poses_test.cpp
               USES incognita::io incognita::world opencv_core opencv_imgcodecs opencv_videoio)
incognita_test(mutation_test SOURCES io/mutation_test.cpp USES incognita::io opencv_core opencv_imgcodecs
               PkgConfig::MATIO)
incognita_test(system_file_test SOURCES io/system_file_test.cpp io/toml_value_test.cpp USES incognita::io)
incognita_test(range_recording_test SOURCES io/car_park_file_test.cpp io/clock_warnings_test.cpp io/mrclam_recording_test.cpp
                                            io/mrclam_team_test.cpp io/published_recordings_test.cpp
                                            io/range_tables_test.cpp io/reflectors_test.cpp
               USES incognita::io incognita::world PkgConfig::MATIO)
incognita_test(path_file_test SOURCES io/path_file_test.cpp USES incognita::io incognita::steering)
incognita_test(target_test SOURCES io/target_test.cpp USES incognita::io)
find_package(CLI11 REQUIRED)
find_package(nlohmann_json REQUIRED)
incognita_test(config_test SOURCES app/config_test.cpp
               USES incognita_app_config CLI11::CLI11 nlohmann_json::nlohmann_json)
incognita_test(terrain_file_test SOURCES io/terrain_file_test.cpp USES incognita::io opencv_core opencv_imgcodecs)
incognita_test(bag_test SOURCES io/bags/bag_test.cpp io/bags/message_cursor_test.cpp USES incognita::bags)
incognita_test(bag_recording_test SOURCES io/bags/bag_parts_test.cpp io/bags/bag_recording_test.cpp
               USES incognita::io incognita::world)
incognita_test(damaged_bag_test SOURCES io/bags/damaged_bag_test.cpp USES incognita::io incognita::world)
# The bags of the repository, written anew by the libraries of the field
foreach(kind ros1 ros2)
  add_test(NAME bags.written_by_${kind} COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/io/bags/check ${kind} ${CMAKE_CURRENT_BINARY_DIR}/bags_${kind}
           $<TARGET_FILE:bag_test> $<TARGET_FILE:bag_recording_test>)
  set_tests_properties(bags.written_by_${kind} PROPERTIES SKIP_RETURN_CODE 77 TIMEOUT 300)
endforeach()
incognita_test(calibrations_test SOURCES io/calibrations_test.cpp USES incognita::io opencv_core)
incognita_test(printed_target_test SOURCES io/printed_target_test.cpp io/cut_target_test.cpp USES incognita::targets incognita::slam)
