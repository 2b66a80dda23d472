# Writes the files of ROOT listed in FILES into the C++ source OUT, as byte arrays, and a function FUNCTION that
# lists them. Run with cmake -P at build time.
set(arrays "")
set(table "")
set(index 0)
foreach(file IN LISTS FILES)
  file(READ "${ROOT}/${file}" hex HEX)
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${hex}")
  string(REGEX REPLACE "(................................................................................)" "\\1\n"
         bytes "${bytes}")
  file(SIZE "${ROOT}/${file}" size)
  string(APPEND arrays "const unsigned char file_${index}[] = {\n${bytes}0};\n")
  string(APPEND table "    {\"${file}\", {reinterpret_cast<const char*>(file_${index}), ${size}}},\n")
  math(EXPR index "${index} + 1")
endforeach()
get_filename_component(folder "${ROOT}" NAME)
file(WRITE "${OUT}.new" "// Generated from ${folder}/ by embed.cmake.
#include \"incognita/io/formats/embedded.hpp\"

namespace incognita {
namespace {
${arrays}
const EmbeddedFile files[] = {
${table}    {\"\", {}}};
}  // namespace

std::span<const EmbeddedFile> ${FUNCTION}() { return std::span(files).first(${index}); }
}  // namespace incognita
")
file(RENAME "${OUT}.new" "${OUT}")
