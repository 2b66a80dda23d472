# incognita_room(NAME SOURCES... USES...): one library target per room of the house. What a room USES are the rooms
# above it and the outside libraries it needs; tools/check-includes holds the sources to the same order.
function(incognita_room name)
  cmake_parse_arguments(ROOM "" "" "SOURCES;USES;PRIVATE_USES" ${ARGN})
  if(ROOM_SOURCES)
    add_library(incognita_${name} STATIC ${ROOM_SOURCES})
    target_include_directories(incognita_${name} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
                                                        $<INSTALL_INTERFACE:include>)
    target_compile_features(incognita_${name} PUBLIC cxx_std_20)
    target_link_libraries(incognita_${name} PUBLIC ${ROOM_USES} PRIVATE ${ROOM_PRIVATE_USES})
    incognita_reuse_precompiled(incognita_${name} incognita_common)
  else()
    add_library(incognita_${name} INTERFACE)
    target_include_directories(incognita_${name} INTERFACE $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
                                                           $<INSTALL_INTERFACE:include>)
    target_compile_features(incognita_${name} INTERFACE cxx_std_20)
    target_link_libraries(incognita_${name} INTERFACE ${ROOM_USES})
  endif()
  set_target_properties(incognita_${name} PROPERTIES EXPORT_NAME ${name})
  set_property(GLOBAL APPEND PROPERTY INCOGNITA_ROOMS incognita_${name})
  add_library(incognita::${name} ALIAS incognita_${name})
endfunction()
