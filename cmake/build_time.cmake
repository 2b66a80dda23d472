# What nearly every source reads first (the standard library, Eigen; in tests GoogleTest too), compiled once instead
# of some 160 times. Every source still includes what it uses; -DINCOGNITA_PRECOMPILED=OFF builds without, and shows
# where one does not.
option(INCOGNITA_PRECOMPILED "Compile the common headers once" ON)

# GCC 12 sees overruns in std::string where there are none (its bug 105651); in a system header it keeps quiet, and
# precompiled it no longer knows that it is one
if(INCOGNITA_PRECOMPILED AND CMAKE_CXX_COMPILER_ID STREQUAL GNU AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  add_compile_options(-Wno-array-bounds -Wno-restrict -Wno-stringop-overflow -Wno-stringop-overread)
endif()

# The preset `release` compiles several sources of a target as one (CMAKE_UNITY_BUILD), so that what they have in common, above
# all templates of Eigen, is compiled once. Then names in anonymous namespaces must differ within a target; the preset `dev`
# compiles file by file, and so does -DCMAKE_UNITY_BUILD=OFF.

# incognita_precompiled_headers(NAME USES... HEADERS...): a target that others reuse the compiled headers of
function(incognita_precompiled_headers name)
  cmake_parse_arguments(COMMON "" "" "USES;HEADERS" ${ARGN})
  if(NOT INCOGNITA_PRECOMPILED)
    return()
  endif()
  set(nothing ${PROJECT_BINARY_DIR}/${name}.cpp)
  file(CONFIGURE OUTPUT ${nothing} CONTENT "// Only carries the precompiled headers\n")
  add_library(${name} OBJECT ${nothing})
  target_link_libraries(${name} PRIVATE ${COMMON_USES})
  target_compile_definitions(${name} PRIVATE ${INCOGNITA_EIGEN_LAYOUT})
  target_precompile_headers(${name} PRIVATE ${COMMON_HEADERS})
endfunction()

# incognita_reuse_precompiled(TARGET NAME)
function(incognita_reuse_precompiled target name)
  if(TARGET ${name})
    target_precompile_headers(${target} REUSE_FROM ${name})
  endif()
endfunction()

incognita_precompiled_headers(
  incognita_common USES Eigen3::Eigen
  HEADERS <algorithm> <array> <chrono> <cmath> <filesystem> <fstream> <functional> <map> <memory> <optional> <sstream>
          <string> <vector> <Eigen/Core> <Eigen/Cholesky> <Eigen/Geometry> <Eigen/LU>)

# incognita_cold(TARGET): words and files, where nothing is worth the compiler's time. Not for what multiplies
# matrices: of a template compiled twice the linker keeps either.
function(incognita_cold target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
endfunction()
