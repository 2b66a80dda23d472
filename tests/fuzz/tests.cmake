incognita_test(system_replay_test SOURCES fuzz/replay.cpp fuzz/system_fuzz.cpp
               USES incognita::systems incognita::io)
target_link_libraries(system_replay_test PRIVATE PkgConfig::GINAC)
incognita_test(viewer_message_replay_test SOURCES fuzz/viewer_message_replay.cpp fuzz/viewer_message_fuzz.cpp
               USES incognita::live)
if(INCOGNITA_SANITIZE)
  set(slowness 10)
else()
  set(slowness 1)
endif()
incognita_test(run_replay_test SOURCES fuzz/run_replay.cpp fuzz/run_fuzz.cpp USES incognita::record)
foreach(replay system_replay_test run_replay_test)
  target_compile_definitions(${replay} PRIVATE INCOGNITA_SLOWNESS=${slowness})  # how much longer it may take
endforeach()

# fuzz/system_fuzz.cpp, run_fuzz.cpp and viewer_message_fuzz.cpp describe the build with clang
option(INCOGNITA_FUZZ "Build the fuzz targets (clang, with INCOGNITA_SANITIZE=fuzzer-no-link,address,undefined)" OFF)
if(INCOGNITA_FUZZ)
  if(NOT CMAKE_CXX_COMPILER_ID STREQUAL Clang OR NOT INCOGNITA_SANITIZE MATCHES fuzzer-no-link)
    message(FATAL_ERROR "INCOGNITA_FUZZ needs -DCMAKE_CXX_COMPILER=clang++ and "
                        "-DINCOGNITA_SANITIZE=fuzzer-no-link,address,undefined")
  endif()
  add_executable(system_fuzz fuzz/system_fuzz.cpp)
  target_link_libraries(system_fuzz PRIVATE incognita::systems incognita::io PkgConfig::GINAC)
  add_executable(run_fuzz fuzz/run_fuzz.cpp)
  target_link_libraries(run_fuzz PRIVATE incognita::record)
  add_executable(viewer_message_fuzz fuzz/viewer_message_fuzz.cpp)
  target_link_libraries(viewer_message_fuzz PRIVATE incognita::live)
  foreach(target system_fuzz run_fuzz viewer_message_fuzz)
    target_link_options(${target} PRIVATE -fsanitize=fuzzer)
  endforeach()
endif()
