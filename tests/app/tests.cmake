find_package(nlohmann_json REQUIRED)
find_package(fmt REQUIRED)
# The built program, run as a child process
incognita_test(program_test
               SOURCES app/program.cpp app/program_usage_test.cpp app/program_scenario_test.cpp app/program_run_test.cpp
                       app/program_recording_test.cpp app/program_disk_test.cpp app/program_evaluate_test.cpp
               USES incognita::io incognita::world opencv_core opencv_imgcodecs nlohmann_json::nlohmann_json fmt::fmt)
target_compile_definitions(program_test PRIVATE INCOGNITA_PROGRAM="$<TARGET_FILE:incognita_program>"
                                                INCOGNITA_VERSION="${PROJECT_VERSION}")
add_dependencies(program_test incognita_program)
