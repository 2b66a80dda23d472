find_package(fmt REQUIRED)
find_package(nlohmann_json 3.11 REQUIRED)
find_package(PkgConfig REQUIRED)
pkg_check_modules(MATIO REQUIRED IMPORTED_TARGET GLOBAL matio)

find_package(Boost 1.74 REQUIRED)  # headers only: CRC-32

incognita_room(record
  SOURCES record/consistency_summary.cpp record/durable_file.cpp record/exploration_summary.cpp record/folders.cpp record/image_text.cpp record/map_files.cpp
          record/map_survey.cpp record/mat_file.cpp record/mcap_file.cpp record/mcap_records.cpp record/message_schemas.cpp record/number.cpp
          record/padded_file.cpp record/path_summary.cpp record/pose_rows.cpp record/recorder.cpp
          record/row_file.cpp record/run_directory.cpp record/run_report.cpp record/run_summary.cpp record/series.cpp
          record/snapshot_log.cpp record/snapshot_message.cpp record/team_summary.cpp record/team_tables.cpp
          record/timing_table.cpp record/tum.cpp record/viewer_messages.cpp record/write_at.cpp
  USES incognita::math incognita::models incognita::messages incognita::analysis
  PRIVATE_USES Boost::headers fmt::fmt nlohmann_json::nlohmann_json opencv_core opencv_imgcodecs PkgConfig::MATIO)

# apart, because only who wants pictures should need OpenCV's drawing
incognita_room(pictures SOURCES record/frame_pictures.cpp USES incognita::record
  PRIVATE_USES fmt::fmt opencv_core opencv_imgproc opencv_imgcodecs)
