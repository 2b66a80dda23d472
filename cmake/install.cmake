# `cmake --install build --prefix DIR`: the program, the rooms as libraries with their headers, and what
# find_package(incognita) reads. A room is then incognita::<room>, as with add_subdirectory.
include(CMakePackageConfigHelpers)
get_property(rooms GLOBAL PROPERTY INCOGNITA_ROOMS)
set(package ${CMAKE_INSTALL_LIBDIR}/cmake/incognita)

install(TARGETS incognita_program RUNTIME)
install(TARGETS ${rooms} EXPORT incognita-targets)
install(DIRECTORY incognita/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/incognita FILES_MATCHING PATTERN *.hpp
        # the command line is no library
        PATTERN app/config.hpp EXCLUDE PATTERN app/run.hpp EXCLUDE PATTERN app/usage.hpp EXCLUDE
        PATTERN app/progress.hpp EXCLUDE PATTERN app/say.hpp EXCLUDE PATTERN app/standard_streams.hpp EXCLUDE
        PATTERN app/reproduce.hpp EXCLUDE PATTERN app/observe.hpp EXCLUDE)
install(EXPORT incognita-targets NAMESPACE incognita:: DESTINATION ${package})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/incognita-config-version.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES cmake/incognita-config.cmake cmake/opencv.cmake ${PROJECT_BINARY_DIR}/incognita-config-version.cmake
        DESTINATION ${package})
