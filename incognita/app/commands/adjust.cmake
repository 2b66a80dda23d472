# `incognita adjust`: a separate target, since it needs no world
find_package(CLI11 REQUIRED)
add_library(incognita_app_adjust STATIC app/commands/adjust.cpp app/commands/recorded_matches.cpp)
target_link_libraries(incognita_app_adjust PUBLIC incognita::slam incognita::record PRIVATE incognita::io CLI11::CLI11 fmt::fmt)
incognita_reuse_precompiled(incognita_app_adjust incognita_common)
incognita_cold(incognita_app_adjust)
