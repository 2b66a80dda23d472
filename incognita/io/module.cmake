# Scenario files, calibration, targets, recordings.
if(NOT fmt_FOUND)
  find_package(fmt REQUIRED)
endif()

find_package(PkgConfig REQUIRED)
pkg_check_modules(MATIO REQUIRED IMPORTED_TARGET GLOBAL matio)
pkg_check_modules(YAML_CPP REQUIRED IMPORTED_TARGET GLOBAL yaml-cpp)

# incognita_embed(FOLDER FUNCTION PATTERN...): files of FOLDER (absolute), built into the program so that it runs
# from any folder, and listed by FUNCTION. Adds the source to embedded_sources.
function(incognita_embed folder function)
  set(root ${folder})
  list(TRANSFORM ARGN PREPEND ${root}/ OUTPUT_VARIABLE patterns)
  file(GLOB names RELATIVE ${root} CONFIGURE_DEPENDS ${patterns})
  list(TRANSFORM names PREPEND ${root}/ OUTPUT_VARIABLE paths)
  set(source ${CMAKE_CURRENT_BINARY_DIR}/io/${function}.cpp)
  add_custom_command(
    OUTPUT ${source}
    COMMAND ${CMAKE_COMMAND} -DROOT=${root} "-DFILES=${names}" -DFUNCTION=${function} -DOUT=${source}
            -P ${CMAKE_CURRENT_SOURCE_DIR}/io/embed.cmake
    DEPENDS ${paths} ${CMAKE_CURRENT_SOURCE_DIR}/io/embed.cmake
    COMMENT "Building in ${function}"
    VERBATIM)
  set_source_files_properties(${source} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)  # large, with names of their own
  set(embedded_sources ${embedded_sources} ${source} PARENT_SCOPE)
endfunction()

file(MAKE_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}/io)
incognita_embed(${PROJECT_SOURCE_DIR}/scenarios embedded_files *.toml targets/*.toml targets/*.pgm)
incognita_embed(${PROJECT_SOURCE_DIR}/systems embedded_systems *.toml)

# Bags of ROS and run.mcap: a target of its own, because record/ reads MCAP files and needs no other reader
pkg_check_modules(LZ4 REQUIRED IMPORTED_TARGET GLOBAL liblz4)
pkg_check_modules(ZSTD REQUIRED IMPORTED_TARGET GLOBAL libzstd)
find_package(BZip2 REQUIRED)
find_package(Boost 1.74 REQUIRED)  # headers only: CRC-32
incognita_module(bags FOLDERS io/bags USES incognita::math incognita::messages
                 PRIVATE_USES Boost::headers fmt::fmt PkgConfig::YAML_CPP PkgConfig::LZ4 PkgConfig::ZSTD
                              BZip2::BZip2)

# Streams of the network; OpenCV's videoio uses the same libraries
pkg_check_modules(FFMPEG REQUIRED IMPORTED_TARGET GLOBAL libavformat libavcodec libavutil libswscale)

incognita_module(io FOLDERS io/formats io/scenario io/calibrations io/recordings io/recordings/bags io/cameras
                 SOURCES ${embedded_sources}
                 USES incognita::models incognita::messages incognita::analysis incognita::world incognita::bags
                 PRIVATE_USES fmt::fmt opencv_core opencv_imgcodecs opencv_imgproc opencv_videoio PkgConfig::FFMPEG PkgConfig::MATIO
                              PkgConfig::YAML_CPP)
target_compile_definitions(incognita_io PRIVATE INCOGNITA_VERSION="${PROJECT_VERSION}")

# Separate, since nothing else draws
pkg_check_modules(CAIRO REQUIRED IMPORTED_TARGET GLOBAL cairo)
incognita_module(targets FOLDERS io/targets USES incognita::io incognita::vision PRIVATE_USES fmt::fmt PkgConfig::CAIRO)
incognita_cold(incognita_targets)

include(app/commands/config.cmake OPTIONAL)
