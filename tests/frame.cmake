# Tests of the project besides its code.
add_test(NAME frame.include_directions COMMAND ${PROJECT_SOURCE_DIR}/tools/check-includes)
add_test(NAME frame.include_check_finds_mistakes COMMAND ${PROJECT_SOURCE_DIR}/tools/check-includes --self-test)
add_test(NAME frame.dependencies_argued_for COMMAND ${PROJECT_SOURCE_DIR}/tools/check-dependencies)

# Use of the library in another project: by add_subdirectory and installed, by find_package
set(another ${CMAKE_CURRENT_SOURCE_DIR}/library)
set(another_build ${CMAKE_CURRENT_BINARY_DIR}/library)
set(another_prefix ${another_build}/prefix)
set(another_flags ${CMAKE_CXX_FLAGS})
if(INCOGNITA_SANITIZE)
  string(APPEND another_flags " -fsanitize=${INCOGNITA_SANITIZE}")
endif()
set(installed -DCMAKE_PREFIX_PATH=${another_prefix} -DEVERY_MODULE=ON)
set(beside -DINCOGNITA_SOURCE=${PROJECT_SOURCE_DIR})

add_test(NAME frame.library_forgotten COMMAND ${CMAKE_COMMAND} -E rm -rf ${another_build})
add_test(NAME frame.library_installs COMMAND ${CMAKE_COMMAND} --install ${PROJECT_BINARY_DIR} --prefix ${another_prefix})
foreach(way installed beside)
  add_test(NAME frame.library_used_${way}
           COMMAND ${CMAKE_CTEST_COMMAND} --build-and-test ${another} ${another_build}/${way} --build-generator Ninja
                   --build-options ${${way}} -DREADME=${PROJECT_SOURCE_DIR}/README.md -DCMAKE_BUILD_TYPE=Debug
                   -DCMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER} "-DCMAKE_CXX_FLAGS=${another_flags}"
                   --test-command ${CMAKE_CTEST_COMMAND} --output-on-failure)
endforeach()
set_tests_properties(frame.library_forgotten PROPERTIES FIXTURES_SETUP empty_prefix)
set_tests_properties(frame.library_installs PROPERTIES FIXTURES_REQUIRED empty_prefix FIXTURES_SETUP installed_library)
set_tests_properties(frame.library_used_installed PROPERTIES FIXTURES_REQUIRED installed_library)
set_tests_properties(frame.library_used_beside PROPERTIES FIXTURES_REQUIRED empty_prefix)
