# The server of the page, and what its viewers talk with
find_package(Threads REQUIRED)
incognita_module(live FOLDERS live USES incognita::record
                 PRIVATE_USES Boost::headers nlohmann_json::nlohmann_json fmt::fmt Threads::Threads)
