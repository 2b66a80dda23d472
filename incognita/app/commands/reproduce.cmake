# `incognita reproduce`: a separate target, so that it can be tested with experiments of the tests. The caller passes
# the experiments; none are linked here.
add_library(incognita_app_reproduce STATIC app/commands/reproduce.cpp)
target_link_libraries(incognita_app_reproduce PUBLIC incognita::report PRIVATE incognita_app_folder_lock incognita::io CLI11::CLI11 fmt::fmt
                                                                               nlohmann_json::nlohmann_json)
incognita_reuse_precompiled(incognita_app_reproduce incognita_common)
incognita_cold(incognita_app_reproduce)
