# What holds the project together apart from its code.
add_test(NAME frame.include_directions COMMAND ${PROJECT_SOURCE_DIR}/tools/check-includes)
add_test(NAME frame.include_check_finds_mistakes COMMAND ${PROJECT_SOURCE_DIR}/tools/check-includes --self-test)
add_test(NAME frame.dependencies_argued_for COMMAND ${PROJECT_SOURCE_DIR}/tools/check-dependencies)
