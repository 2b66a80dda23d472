# `incognita config`: a separate target, so that it can be tested without the rest of the program
find_package(nlohmann_json REQUIRED)
find_package(CLI11 REQUIRED)
add_library(incognita_app_config STATIC app/commands/config.cpp app/view/settings_json.cpp)
target_link_libraries(incognita_app_config PUBLIC incognita::io PRIVATE incognita_app CLI11::CLI11 nlohmann_json::nlohmann_json
                                                                        fmt::fmt)
incognita_reuse_precompiled(incognita_app_config incognita_common)
incognita_cold(incognita_app_config)
