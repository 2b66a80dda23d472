# `cmake --install build --prefix DIR`: the program, the modules as libraries with their headers, and what
# find_package(incognita) reads. A module is then incognita::<module>, as with add_subdirectory.
include(CMakePackageConfigHelpers)
get_property(modules GLOBAL PROPERTY INCOGNITA_MODULES)
set(package ${CMAKE_INSTALL_LIBDIR}/cmake/incognita)

install(TARGETS incognita_program RUNTIME)
install(TARGETS ${modules} EXPORT incognita-targets)
install(DIRECTORY incognita/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/incognita FILES_MATCHING PATTERN *.hpp
        # of their own module's sources only; the command line is no library
        PATTERN vision/as_matrix.hpp EXCLUDE PATTERN record/mcap/json_vectors.hpp EXCLUDE
        REGEX "app/commands/(campaign|config|observe|reproduce|run)[.]hpp" EXCLUDE
        PATTERN app/console EXCLUDE PATTERN app/campaign EXCLUDE PATTERN app/view EXCLUDE)
install(EXPORT incognita-targets NAMESPACE incognita:: DESTINATION ${package})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/incognita-config-version.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES cmake/incognita-config.cmake cmake/opencv.cmake ${PROJECT_BINARY_DIR}/incognita-config-version.cmake
        DESTINATION ${package})
