find_package(CLI11 REQUIRED)
# The loop and its wiring: what experiments and tests drive without a command line
incognita_room(app SOURCES app/assemble.cpp app/assemble_planar.cpp app/assemble_room_vehicle.cpp app/assemble_team.cpp app/association_score.cpp app/loop.cpp app/observability_watch.cpp app/operator_assembly.cpp
                           app/snapshot_of.cpp app/snapshot_of_team.cpp app/snapshot_parts.cpp app/team_models.cpp
               USES incognita::slam incognita::decision incognita::control incognita::world incognita::record
                    incognita::io PRIVATE_USES fmt::fmt)
# Used by every command that writes to a folder
add_library(incognita_app_folder_lock STATIC app/folder_lock.cpp)
target_link_libraries(incognita_app_folder_lock PUBLIC incognita::record PRIVATE fmt::fmt)
incognita_reuse_precompiled(incognita_app_folder_lock incognita_common)
include(app/reproduce.cmake)
include(app/observe.cmake)
add_executable(incognita_program app/main.cpp app/run.cpp app/progress.cpp app/scenario_run.cpp app/standard_streams.cpp app/usage.cpp)
incognita_reuse_precompiled(incognita_program incognita_common)
set_target_properties(incognita_program PROPERTIES OUTPUT_NAME incognita)
target_compile_definitions(incognita_program PRIVATE INCOGNITA_VERSION="${PROJECT_VERSION}")
target_link_libraries(incognita_program PRIVATE incognita::app incognita::pictures incognita::report
                      incognita_app_config incognita_app_folder_lock incognita::evaluate incognita_app_reproduce incognita_app_observe
                      CLI11::CLI11 fmt::fmt
                      incognita::experiments)  # made later, in experiments/
include(app/campaign.cmake)
