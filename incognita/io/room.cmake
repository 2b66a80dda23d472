# Scenario files, calibration, targets, recordings.
if(NOT fmt_FOUND)
  find_package(fmt REQUIRED)
endif()

find_package(PkgConfig REQUIRED)
pkg_check_modules(MATIO REQUIRED IMPORTED_TARGET GLOBAL matio)
pkg_check_modules(YAML_CPP REQUIRED IMPORTED_TARGET GLOBAL yaml-cpp)

# incognita_embed(FOLDER FUNCTION PATTERN...): files of the project's FOLDER, built into the program so that it runs
# from any folder, and listed by FUNCTION. Adds the source to embedded_sources.
function(incognita_embed folder function)
  set(root ${PROJECT_SOURCE_DIR}/${folder})
  list(TRANSFORM ARGN PREPEND ${root}/ OUTPUT_VARIABLE patterns)
  file(GLOB names RELATIVE ${root} CONFIGURE_DEPENDS ${patterns})
  list(TRANSFORM names PREPEND ${root}/ OUTPUT_VARIABLE paths)
  set(source ${CMAKE_CURRENT_BINARY_DIR}/io/${function}.cpp)
  add_custom_command(
    OUTPUT ${source}
    COMMAND ${CMAKE_COMMAND} -DROOT=${root} "-DFILES=${names}" -DFUNCTION=${function} -DOUT=${source}
            -P ${CMAKE_CURRENT_SOURCE_DIR}/io/embed.cmake
    DEPENDS ${paths} ${CMAKE_CURRENT_SOURCE_DIR}/io/embed.cmake
    COMMENT "Building in ${folder}/"
    VERBATIM)
  set(embedded_sources ${embedded_sources} ${source} PARENT_SCOPE)
endfunction()

file(MAKE_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}/io)
incognita_embed(scenarios embedded_files *.toml targets/*.toml targets/*.pgm)
incognita_embed(systems embedded_systems *.toml)

incognita_room(io
  SOURCES io/acfr_recording.cpp io/camera.cpp io/camera_checks.cpp io/camera_of_recording.cpp io/clock_warnings.cpp io/data_folder.cpp io/decision_checks.cpp io/decision_setting_list.cpp io/euroc_camera.cpp io/euroc_recording.cpp io/files.cpp io/image_file.cpp
          io/image_folder.cpp io/image_kinds.cpp io/load_scenario.cpp io/mat_numbers.cpp io/mat_structure.cpp io/mrclam_recording.cpp
          io/named_table.cpp io/number_table.cpp io/path_file.cpp io/picture_of_target.cpp io/point_file.cpp io/range_recording.cpp
          io/range_recording_builder.cpp io/range_tables.cpp
          io/recorded.cpp io/recording.cpp io/reflectors.cpp io/scenario_checks.cpp io/scenario_file.cpp io/setting.cpp io/settings.cpp
          io/system_file.cpp io/target_file.cpp io/team_checks.cpp io/terrain_file.cpp io/team_meanings.cpp io/team_setting_list.cpp io/toml_depth.cpp io/toml_value.cpp io/tum_recording.cpp
          ${embedded_sources}
  USES incognita::models incognita::messages incognita::analysis
  PRIVATE_USES fmt::fmt opencv_core opencv_imgcodecs PkgConfig::MATIO PkgConfig::YAML_CPP)
target_compile_definitions(incognita_io PRIVATE INCOGNITA_VERSION="${PROJECT_VERSION}")

include(app/config.cmake OPTIONAL)
