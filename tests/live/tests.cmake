find_package(Boost 1.74 REQUIRED)
find_package(Threads REQUIRED)
incognita_test(live_test SOURCES live/access_test.cpp live/browser_camera_test.cpp live/certificate_test.cpp live/foxglove_messages_test.cpp live/outbox_test.cpp
                                 live/series_history_test.cpp live/url_test.cpp live/viewer_commands_test.cpp
               USES incognita::live nlohmann_json::nlohmann_json)
# Separate, since it alone compiles a client
incognita_test(server_test SOURCES live/server_test.cpp live/client.cpp
               USES incognita::live Boost::headers nlohmann_json::nlohmann_json Threads::Threads)
