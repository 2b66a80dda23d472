# The pages of docs/: consistent list and markers, existing commands, and a sample of their numbers
find_package(Python3 3.11 COMPONENTS Interpreter)
if(NOT Python3_Interpreter_FOUND)
  message(STATUS "No Python 3.11: the pages of docs/ are not checked")
  return()
endif()

function(incognita_docs_test name)
  add_test(NAME ${name} COMMAND ${Python3_EXECUTABLE} ${ARGN} WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
  set_tests_properties(${name} PROPERTIES TIMEOUT 600 LABELS docs)
endfunction()

incognita_docs_test(docs_tool tests/docs/make_docs_test.py)
incognita_docs_test(docs_marks tools/make-docs --lint)
incognita_docs_test(docs_commands_tool tests/docs/doc_commands_test.py $<TARGET_FILE:incognita_program>)
incognita_docs_test(docs_commands tools/check-doc-commands --program $<TARGET_FILE:incognita_program>)
incognita_docs_test(docs_ledger_page_tool tests/docs/ledger_page_test.py)
incognita_docs_test(docs_comparison tests/docs/describe_comparison_test.py)
incognita_docs_test(docs_ledger_page tools/make-ledger-page --check docs/ledger)
if(CMAKE_BUILD_TYPE STREQUAL "Release" AND NOT INCOGNITA_SANITIZE)  # elsewhere it takes too long
  incognita_docs_test(docs_sample tools/make-docs --check --sample --build ${PROJECT_BINARY_DIR})
  set_tests_properties(docs_sample PROPERTIES PROCESSORS 2 LABELS "docs;sample")
endif()
