# The results that `incognita view` shows: a separate target, so that it can be tested without a server
add_library(incognita_app_laboratory STATIC app/view/laboratory.cpp)
target_link_libraries(incognita_app_laboratory PUBLIC incognita::io PRIVATE fmt::fmt)
incognita_reuse_precompiled(incognita_app_laboratory incognita_common)
incognita_cold(incognita_app_laboratory)
