# The modules of the laboratory's pages that need no browser, under Node
find_program(INCOGNITA_NODE node)
if(NOT INCOGNITA_NODE)
  message(STATUS "No Node: the modules of web/laboratory are not tested")
  return()
endif()
file(GLOB laboratory_tests CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/*.test.mjs)
add_test(NAME web_laboratory COMMAND ${INCOGNITA_NODE} --test ${laboratory_tests} WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
set_tests_properties(web_laboratory PROPERTIES TIMEOUT 120 LABELS web)
