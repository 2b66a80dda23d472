# `incognita observe`: a separate target, so that it can be tested without the rest of the program
add_library(incognita_app_observe STATIC app/commands/observe.cpp)
target_link_libraries(incognita_app_observe PRIVATE incognita::systems incognita::io incognita::report CLI11::CLI11
                                                    fmt::fmt)
incognita_reuse_precompiled(incognita_app_observe incognita_common)
incognita_cold(incognita_app_observe)
