find_package(nlohmann_json 3.11 REQUIRED)
incognita_test(record_test SOURCES record/adjusted_path_test.cpp record/consistency_summary_test.cpp record/map_survey_test.cpp record/outcome_summary_test.cpp record/mcap_reader.cpp
                                   record/path_distance_test.cpp record/recorder_test.cpp record/row_file_test.cpp record/run_report_test.cpp
                                   record/state_file_test.cpp
                                   record/tum_test.cpp
               USES incognita::record nlohmann_json::nlohmann_json PkgConfig::MATIO Boost::headers)
incognita_test(mcap_test SOURCES record/mcap_file_test.cpp record/mcap_reader.cpp record/snapshot_log_test.cpp
               USES incognita::record nlohmann_json::nlohmann_json opencv_core opencv_imgcodecs)
incognita_test(replay_test SOURCES record/mcap_index_test.cpp record/mcap_reader.cpp record/recorded_events_test.cpp
                                   record/recorded_run_test.cpp
               USES incognita::record nlohmann_json::nlohmann_json)
incognita_test(damaged_run_test SOURCES record/damaged_run_test.cpp USES incognita::app nlohmann_json::nlohmann_json)
incognita_test(pictures_test SOURCES record/frame_pictures_test.cpp record/image_recording_test.cpp
               USES incognita::pictures opencv_core opencv_imgcodecs)
add_test(NAME mcap.reference_reader COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/record/mcap/check
         $<TARGET_FILE:incognita_program> ${CMAKE_CURRENT_BINARY_DIR}/mcap)
set_tests_properties(mcap.reference_reader PROPERTIES SKIP_RETURN_CODE 77 TIMEOUT 300)
