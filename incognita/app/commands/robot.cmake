# `incognita robot`: its parts are a target of their own, so that they can be tested without the program
add_library(incognita_app_robot STATIC app/robot/robot_log.cpp app/robot/robot_relay.cpp app/robot/robot_server.cpp
                                       app/robot/simulated_robot.cpp)
target_link_libraries(incognita_app_robot PUBLIC incognita::app incognita::live PRIVATE fmt::fmt)
incognita_reuse_precompiled(incognita_app_robot incognita_common)
