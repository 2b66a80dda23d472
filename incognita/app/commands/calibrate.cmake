# `incognita calibrate`
target_sources(incognita_program PRIVATE app/commands/calibrate.cpp app/commands/calibrate_live.cpp
                                         app/commands/calibration_output.cpp app/commands/calibration_report.cpp)
target_link_libraries(incognita_program PRIVATE incognita::calibration incognita::io incognita::record)
