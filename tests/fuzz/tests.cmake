incognita_test(system_replay_test SOURCES fuzz/replay.cpp fuzz/system_fuzz.cpp
               USES incognita::systems incognita::io)
target_link_libraries(system_replay_test PRIVATE PkgConfig::GINAC)
if(INCOGNITA_SANITIZE)
  set(slowness 10)
else()
  set(slowness 1)
endif()
target_compile_definitions(system_replay_test PRIVATE INCOGNITA_SLOWNESS=${slowness})  # how much longer it may take

# fuzz/system_fuzz.cpp describes the build with clang
option(INCOGNITA_FUZZ "Build the fuzz target (clang, with INCOGNITA_SANITIZE=fuzzer-no-link,address,undefined)" OFF)
if(INCOGNITA_FUZZ)
  if(NOT CMAKE_CXX_COMPILER_ID STREQUAL Clang OR NOT INCOGNITA_SANITIZE MATCHES fuzzer-no-link)
    message(FATAL_ERROR "INCOGNITA_FUZZ needs -DCMAKE_CXX_COMPILER=clang++ and "
                        "-DINCOGNITA_SANITIZE=fuzzer-no-link,address,undefined")
  endif()
  add_executable(system_fuzz fuzz/system_fuzz.cpp)
  target_link_libraries(system_fuzz PRIVATE incognita::systems incognita::io PkgConfig::GINAC)
  target_link_options(system_fuzz PRIVATE -fsanitize=fuzzer)
endif()
