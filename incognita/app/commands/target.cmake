# `incognita target`
target_sources(incognita_program PRIVATE app/commands/target.cpp)
target_link_libraries(incognita_program PRIVATE incognita::targets incognita::io incognita::record)
