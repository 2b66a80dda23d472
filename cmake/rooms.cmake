include(GNUInstallDirs)

# Eigen lays its types out, and takes and gives back memory, by what the processor is said to have and whether a
# sanitizer is on. A program built with -march=native must do both as the library does.
set(INCOGNITA_EIGEN_LAYOUT EIGEN_MAX_ALIGN_BYTES=16 EIGEN_MALLOC_ALREADY_ALIGNED=0)

# incognita_room(NAME SOURCES... USES...): one library target per room of the house. What a room USES are the rooms
# above it and the outside libraries it needs; tools/check-includes holds the sources to the same order.
function(incognita_room name)
  cmake_parse_arguments(ROOM "" "" "SOURCES;USES;PRIVATE_USES" ${ARGN})
  if(ROOM_SOURCES)
    add_library(incognita_${name} STATIC ${ROOM_SOURCES})
    target_include_directories(incognita_${name} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
                                                        $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
    target_compile_features(incognita_${name} PUBLIC cxx_std_20)
    target_compile_definitions(incognita_${name} PUBLIC ${INCOGNITA_EIGEN_LAYOUT})
    target_link_libraries(incognita_${name} PUBLIC ${ROOM_USES} PRIVATE ${ROOM_PRIVATE_USES})
    incognita_reuse_precompiled(incognita_${name} incognita_common)
  else()
    add_library(incognita_${name} INTERFACE)
    target_include_directories(incognita_${name} INTERFACE $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
                                                           $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
    target_compile_features(incognita_${name} INTERFACE cxx_std_20)
    target_compile_definitions(incognita_${name} INTERFACE ${INCOGNITA_EIGEN_LAYOUT})
    target_link_libraries(incognita_${name} INTERFACE ${ROOM_USES})
  endif()
  set_target_properties(incognita_${name} PROPERTIES EXPORT_NAME ${name})
  set_property(GLOBAL APPEND PROPERTY INCOGNITA_ROOMS incognita_${name})
  add_library(incognita::${name} ALIAS incognita_${name})
endfunction()
