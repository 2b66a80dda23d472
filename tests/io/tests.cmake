incognita_test(pinhole_test SOURCES models/pinhole_test.cpp models/fisheye_test.cpp USES incognita::models opencv_core opencv_calib3d)
incognita_test(settings_test SOURCES io/settings_test.cpp io/decision_checks_test.cpp io/enum_words_test.cpp USES incognita::io)
incognita_test(recording_test SOURCES io/euroc_camera_test.cpp io/recording_test.cpp USES incognita::io incognita::world opencv_core opencv_imgcodecs)
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
incognita_test(calibrations_test SOURCES io/calibrations_test.cpp USES incognita::io opencv_core)
incognita_test(printed_target_test SOURCES io/printed_target_test.cpp io/cut_target_test.cpp USES incognita::targets incognita::slam)
