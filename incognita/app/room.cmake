find_package(CLI11 REQUIRED)
add_executable(incognita_program app/main.cpp app/run.cpp app/assemble.cpp app/loop.cpp app/snapshot_of.cpp
               app/progress.cpp)
set_target_properties(incognita_program PROPERTIES OUTPUT_NAME incognita)
target_compile_definitions(incognita_program PRIVATE INCOGNITA_VERSION="${PROJECT_VERSION}")
target_link_libraries(incognita_program PRIVATE incognita::slam incognita::decision incognita::control incognita::world
                      incognita::record incognita::pictures incognita::report incognita::io incognita_app_config
                      incognita::evaluate CLI11::CLI11 fmt::fmt)
