include(GNUInstallDirs)

# Eigen lays its types out, and takes and gives back memory, by what the processor is said to have and whether a
# sanitizer is on. A program built with -march=native must do both as the library does.
set(INCOGNITA_EIGEN_LAYOUT EIGEN_MAX_ALIGN_BYTES=16 EIGEN_MALLOC_ALREADY_ALIGNED=0)

# incognita_module(NAME FOLDERS... SOURCES... WITHOUT... USES... PRIVATE_USES...): one library target of the sources in
# FOLDERS (not below them) less WITHOUT, and of SOURCES. A module USES modules above it and outside libraries;
# tools/check-includes holds the sources to the same order.
function(incognita_module name)
  cmake_parse_arguments(MODULE "" "" "FOLDERS;SOURCES;WITHOUT;USES;PRIVATE_USES" ${ARGN})
  set(sources)
  if(MODULE_FOLDERS)
    list(TRANSFORM MODULE_FOLDERS APPEND /*.cpp)
    file(GLOB sources RELATIVE ${CMAKE_CURRENT_SOURCE_DIR} CONFIGURE_DEPENDS ${MODULE_FOLDERS})
  endif()
  if(MODULE_WITHOUT)
    list(REMOVE_ITEM sources ${MODULE_WITHOUT})
  endif()
  list(APPEND sources ${MODULE_SOURCES})
  if(sources)
    set(scope PUBLIC)
    add_library(incognita_${name} STATIC ${sources})
    target_link_libraries(incognita_${name} PRIVATE ${MODULE_PRIVATE_USES})
    incognita_reuse_precompiled(incognita_${name} incognita_common)
  else()
    set(scope INTERFACE)
    add_library(incognita_${name} INTERFACE)
  endif()
  target_include_directories(incognita_${name} ${scope} $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
                                                        $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_compile_features(incognita_${name} ${scope} cxx_std_20)
  target_compile_definitions(incognita_${name} ${scope} ${INCOGNITA_EIGEN_LAYOUT})
  target_link_libraries(incognita_${name} ${scope} ${MODULE_USES})
  set_target_properties(incognita_${name} PROPERTIES EXPORT_NAME ${name})
  set_property(GLOBAL APPEND PROPERTY INCOGNITA_MODULES incognita_${name})
  add_library(incognita::${name} ALIAS incognita_${name})
endfunction()
