// TOML values with their locations in the file.
#include "incognita/io/formats/toml_value.hpp"

#include <gtest/gtest.h>

#include <string>
#include <variant>

#include "incognita/io/formats/toml_depth.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

using testing::message_of;

TEST(TomlValue, HasItsLocation) {
  const TomlTable table = parse_toml(
      "b = \"one\" # \nlong = '''one'''\nesc = \"o\\n\"\n\"\xce\xb8\" = '\xce\xb8'\n"
      "t = { z = 1, a = \"two\" }\na.c = [1, -2]\n",
      "f");
  std::string keys;
  for (const TomlEntry& entry : table)
    keys += entry.key + ":" + std::to_string(entry.value.text_column) + " ";
  EXPECT_EQ(keys, "b:6 long:8 esc:7 \xce\xb8:8 t:5 a:1 ");
  const auto& inner = std::get<TomlTable>(table[4].value.value);
  EXPECT_EQ(inner[0].key, "z");  // in the order of the file, not alphabetical
  EXPECT_EQ(inner[0].column, 7);
  EXPECT_EQ(inner[1].column, 14);
  EXPECT_EQ(inner[1].value.column, 18);
  EXPECT_EQ(inner[1].value.text_column, 19);
  const auto& c = std::get<TomlTable>(table[5].value.value)[0];
  EXPECT_EQ(c.column, 3);
  EXPECT_EQ(std::get<TomlArray>(c.value.value)[1].column, 11);
}

// The parser recurses into tables; half a million nested ones would overflow the stack
TEST(TomlValue, RefusesDeepNesting) {
  std::string deep;
  for (int i = 0; i < 60'000; ++i) deep += "a . 'b' .\"c\\\"\".";
  for (const std::string& text : {deep + "d = 1", "x = 1\n[" + deep + "d]", "x = { " + deep + "d = 1 }"})
    EXPECT_HAS(message_of([&] { parse_toml(text, "f"); }), "a key of more than 100 parts");
  EXPECT_HAS(message_of([&] { parse_toml("\n" + deep, "f"); }), "f:2: not valid TOML");
  EXPECT_EQ(find_deep_key("\n" + deep)->line, 2);
  std::string numbers = "a = [";
  for (int i = 0; i < 1000; ++i) numbers += "1.5, -2.5e-3, '.', # .a.b.c\n";
  EXPECT_FALSE(find_deep_key(numbers + "]"));
  EXPECT_FALSE(find_deep_key("a = \"" + deep.substr(0, 3) + "\"\nb = '" + std::string(500, '.') + "'"));
  EXPECT_FALSE(find_deep_key("a = \"\"\"" + std::string(500, '.') + "\"\"\"\n# " + std::string(500, '.')));
}

}  // namespace
}  // namespace incognita
