# The live page: its computations with Node.js alone, the page itself in Chromium. Skipped where these are missing.
find_program(NODE_EXECUTABLE node)
if(NODE_EXECUTABLE)
  file(GLOB unit_tests CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/web/*.test.mjs)
  add_test(NAME web.unit COMMAND ${NODE_EXECUTABLE} --test ${unit_tests})
  set_tests_properties(web.unit PROPERTIES TIMEOUT 60 LABELS web)
else()
  message(STATUS "No Node.js: the computations of the live page are not tested")
endif()

file(GLOB browser_tests RELATIVE ${CMAKE_CURRENT_SOURCE_DIR}/web/browser CONFIGURE_DEPENDS
     ${CMAKE_CURRENT_SOURCE_DIR}/web/browser/*.test.mjs)
foreach(file ${browser_tests})
  string(REPLACE ".test.mjs" "" name ${file})
  add_test(NAME web.browser.${name} COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/web/browser/check
           $<TARGET_FILE:incognita_program> ${CMAKE_CURRENT_BINARY_DIR}/web ${file})
  # One at a time: they share a folder, and measure what a browser with a software renderer can do
  set_tests_properties(web.browser.${name} PROPERTIES SKIP_RETURN_CODE 77 TIMEOUT 900 LABELS "web;browser"
                       RESOURCE_LOCK browser PROCESSORS 2)
endforeach()

# The types in the comments of the page; downloads TypeScript
add_test(NAME web.types COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/web/types/check ${CMAKE_CURRENT_BINARY_DIR}/web_types)
set_tests_properties(web.types PROPERTIES SKIP_RETURN_CODE 77 TIMEOUT 300 LABELS web)
