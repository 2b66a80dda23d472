incognita_test(navigator_test SOURCES navigator/navigator_test.cpp navigator/examples_test.cpp
               USES incognita::navigator incognita::io incognita::world)
set(examples own_images own_range_bearing active_choice two_robots)
foreach(example ${examples})
  target_compile_definitions(navigator_test PRIVATE EXAMPLE_${example}="${PROJECT_BINARY_DIR}/example_${example}")
  add_dependencies(navigator_test example_${example})
endforeach()
