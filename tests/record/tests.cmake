find_package(nlohmann_json 3.11 REQUIRED)
incognita_test(record_test SOURCES record/mcap_reader.cpp record/recorder_test.cpp record/row_file_test.cpp
                                   record/tum_test.cpp
               USES incognita::record nlohmann_json::nlohmann_json PkgConfig::MATIO)
incognita_test(mcap_test SOURCES record/mcap_file_test.cpp record/mcap_reader.cpp record/snapshot_log_test.cpp
               USES incognita::record nlohmann_json::nlohmann_json opencv_core opencv_imgcodecs)
incognita_test(pictures_test SOURCES record/frame_pictures_test.cpp
               USES incognita::pictures opencv_core opencv_imgcodecs)
