find_package(Boost 1.74 REQUIRED)
find_package(Threads REQUIRED)
incognita_test(live_test SOURCES live/access_test.cpp live/browser_camera_test.cpp live/certificate_test.cpp live/connections_test.cpp
                                 live/drive_watchdog_test.cpp live/foxglove_messages_test.cpp live/outbox_test.cpp
                                 live/series_history_test.cpp live/url_test.cpp live/viewer_commands_test.cpp
               USES incognita::live nlohmann_json::nlohmann_json)
# Separate, since it alone compiles a client
incognita_test(server_test SOURCES live/server_test.cpp live/state_channel_test.cpp live/client.cpp
               USES incognita::live Boost::headers nlohmann_json::nlohmann_json Threads::Threads)
incognita_test(robot_protocol_test SOURCES live/robot/rosbridge_test.cpp live/robot/ros_messages_test.cpp live/robot/watchdog_test.cpp
               USES incognita::live nlohmann_json::nlohmann_json)
incognita_test(robot_link_test SOURCES live/robot/link_test.cpp live/client.cpp
               USES incognita::live Boost::headers nlohmann_json::nlohmann_json Threads::Threads)
# The robot's side with a foreign client. Skipped without Node.js or the package
add_test(NAME live.roslib COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/live/roslib/check $<TARGET_FILE:incognita_program>
                                  ${CMAKE_CURRENT_BINARY_DIR}/roslib)
set_tests_properties(live.roslib PROPERTIES SKIP_RETURN_CODE 77 TIMEOUT 300)
