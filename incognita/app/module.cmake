find_package(CLI11 REQUIRED)
find_package(PkgConfig REQUIRED)
pkg_check_modules(QRENCODE REQUIRED IMPORTED_TARGET libqrencode)
# The loop and its assembly, used by experiments and tests without a command line
incognita_module(app FOLDERS app/loop WITHOUT app/loop/scenario_run.cpp
                 USES incognita::slam incognita::decision incognita::control incognita::world incognita::record
                      incognita::io incognita::live PRIVATE_USES fmt::fmt)
# Used by every command that writes to a folder
add_library(incognita_app_folder_lock STATIC app/console/folder_lock.cpp)
target_link_libraries(incognita_app_folder_lock PUBLIC incognita::record PRIVATE fmt::fmt)
incognita_reuse_precompiled(incognita_app_folder_lock incognita_common)
include(app/commands/reproduce.cmake)
include(app/commands/observe.cmake)
include(app/commands/adjust.cmake)
include(app/commands/robot.cmake)
include(app/view/page.cmake)
add_executable(incognita_program app/commands/main.cpp app/commands/run.cpp app/commands/recorder_sink.cpp app/commands/page_options.cpp app/commands/view.cpp app/commands/robot.cpp app/console/interrupt.cpp app/console/progress.cpp app/console/qr_code.cpp app/console/save_request.cpp app/console/shown_reading.cpp app/loop/scenario_run.cpp app/console/standard_streams.cpp app/console/usage.cpp)
incognita_reuse_precompiled(incognita_program incognita_common)
set_target_properties(incognita_program PROPERTIES OUTPUT_NAME incognita)
target_compile_definitions(incognita_program PRIVATE INCOGNITA_VERSION="${PROJECT_VERSION}")
target_link_libraries(incognita_program PRIVATE incognita_app_view incognita::app incognita::pictures incognita::report
                      incognita_app_config incognita_app_adjust incognita_app_robot incognita_app_folder_lock incognita::evaluate incognita_app_reproduce incognita_app_observe
                      CLI11::CLI11 fmt::fmt PkgConfig::QRENCODE
                      incognita::experiments)  # defined later, in experiments/
include(app/commands/campaign.cmake)
include(app/commands/calibrate.cmake)
include(app/commands/target.cmake)
include(app/view/laboratory.cmake)
