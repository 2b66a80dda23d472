# The server of the page, what its viewers talk with, and the link to robots
find_package(Threads REQUIRED)
find_package(OpenSSL REQUIRED)
incognita_module(live FOLDERS live live/robot USES incognita::record
                 PRIVATE_USES Boost::headers nlohmann_json::nlohmann_json fmt::fmt Threads::Threads OpenSSL::SSL OpenSSL::Crypto)
# Their implementations have members of types in an anonymous namespace, of which GCC warns in a source that another includes
set_source_files_properties(live/server.cpp live/robot/rosbridge_client.cpp PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
