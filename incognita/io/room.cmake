# Scenario files, calibration, targets, recordings.
if(NOT fmt_FOUND)
  find_package(fmt REQUIRED)
endif()

find_package(PkgConfig REQUIRED)
pkg_check_modules(MATIO REQUIRED IMPORTED_TARGET GLOBAL matio)

# scenarios/ is built into the program: it runs from any folder
file(GLOB embedded_names RELATIVE ${PROJECT_SOURCE_DIR}/scenarios CONFIGURE_DEPENDS
     ${PROJECT_SOURCE_DIR}/scenarios/*.toml ${PROJECT_SOURCE_DIR}/scenarios/targets/*.toml
     ${PROJECT_SOURCE_DIR}/scenarios/targets/*.pgm)
list(TRANSFORM embedded_names PREPEND ${PROJECT_SOURCE_DIR}/scenarios/ OUTPUT_VARIABLE embedded_paths)
set(embedded_source ${CMAKE_CURRENT_BINARY_DIR}/io/embedded.cpp)
add_custom_command(
  OUTPUT ${embedded_source}
  COMMAND ${CMAKE_COMMAND} -DROOT=${PROJECT_SOURCE_DIR}/scenarios "-DFILES=${embedded_names}" -DOUT=${embedded_source}
          -P ${CMAKE_CURRENT_SOURCE_DIR}/io/embed.cmake
  DEPENDS ${embedded_paths} ${CMAKE_CURRENT_SOURCE_DIR}/io/embed.cmake
  COMMENT "Building in scenarios/"
  VERBATIM)
file(MAKE_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}/io)

incognita_room(io
  SOURCES io/acfr_recording.cpp io/camera.cpp io/data_folder.cpp io/euroc_recording.cpp io/files.cpp io/image_file.cpp
          io/image_folder.cpp io/load_scenario.cpp io/mat_numbers.cpp io/mat_structure.cpp io/mrclam_recording.cpp
          io/named_table.cpp io/nearest_name.cpp io/number_table.cpp io/range_recording.cpp
          io/range_recording_builder.cpp io/range_tables.cpp io/recorded.cpp io/recording.cpp io/reflectors.cpp
          io/scenario_checks.cpp io/setting.cpp io/settings.cpp io/target_file.cpp io/toml_value.cpp
          io/tum_recording.cpp ${embedded_source}
  USES incognita::models incognita::messages
  PRIVATE_USES fmt::fmt opencv_core opencv_imgcodecs PkgConfig::MATIO)
target_compile_definitions(incognita_io PRIVATE INCOGNITA_VERSION="${PROJECT_VERSION}")

include(app/config.cmake OPTIONAL)
