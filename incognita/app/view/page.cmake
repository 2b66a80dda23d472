# The page: web/ and the libraries it uses are built into the program. Without the libraries the program is built all the
# same, and `--view` says what is missing.
set(embedded_sources)
incognita_embed(${PROJECT_SOURCE_DIR}/web embedded_page *.html *.css *.js *.svg */*.html */*.css */*.js */*/*.css */*/*.js)
set(libraries_root ${CMAKE_CURRENT_BINARY_DIR}/page_libraries)
file(REMOVE_RECURSE ${libraries_root})
file(MAKE_DIRECTORY ${libraries_root})
find_path(THREE_JS_FOLDER three.module.js PATHS /usr/share/javascript/three NO_DEFAULT_PATH)
find_path(D3_FOLDER d3.min.js PATHS /usr/share/nodejs/d3/dist NO_DEFAULT_PATH)
if(THREE_JS_FOLDER AND D3_FOLDER)
  configure_file(${THREE_JS_FOLDER}/three.module.js ${libraries_root}/three/build/three.module.js COPYONLY)
  configure_file(${THREE_JS_FOLDER}/examples/jsm/controls/OrbitControls.js
                 ${libraries_root}/three/examples/jsm/controls/OrbitControls.js COPYONLY)
  configure_file(${D3_FOLDER}/d3.min.js ${libraries_root}/d3.min.js COPYONLY)
else()
  message(WARNING "three.js or d3 is missing, hence the program has no page; on Debian: "
                  "apt-get install libjs-three node-d3")
endif()
incognita_embed(${libraries_root} embedded_libraries *.js three/build/*.js three/examples/jsm/controls/*.js)

file(GLOB view_sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/app/view/*.cpp)
list(FILTER view_sources EXCLUDE REGEX "/(settings_json|laboratory).cpp$")  # in targets of their own
add_library(incognita_app_view STATIC ${view_sources} ${embedded_sources})
target_compile_definitions(incognita_app_view PRIVATE INCOGNITA_VERSION="${PROJECT_VERSION}")
target_link_libraries(incognita_app_view PUBLIC incognita::live incognita::app incognita_app_laboratory
                      PRIVATE incognita_app_config nlohmann_json::nlohmann_json fmt::fmt)
incognita_reuse_precompiled(incognita_app_view incognita_common)
