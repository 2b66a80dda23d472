#include "incognita/io/toml_value.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

// The library's own assertions end the program on some malformed input, where an error is wanted. With NDEBUG
// it would ignore this setting and tell some compilers to assume what a file may well violate.
#undef NDEBUG
#define TOML_ASSERT(condition) static_cast<void>(0)
#define TOML_HEADER_ONLY 1
#define TOML_EXCEPTIONS 1
#include <toml++/toml.h>

#include "incognita/messages/errors.hpp"

namespace incognita {
namespace {

TomlValue convert(const toml::node& node);

int line_of(const toml::source_region& region) { return static_cast<int>(region.begin.line); }

TomlTable convert_table(const toml::table& table) {
  TomlTable entries;
  for (const auto& [key, node] : table) {
    entries.push_back({std::string(key.str()), line_of(key.source()), convert(node)});
  }
  std::stable_sort(entries.begin(), entries.end(),
                   [](const TomlEntry& a, const TomlEntry& b) { return a.line < b.line; });
  return entries;
}

TomlValue convert(const toml::node& node) {
  TomlValue to{TomlDate{}, line_of(node.source())};
  if (const auto* text = node.as_string()) to.value = text->get();
  if (const auto* whole = node.as_integer()) to.value = whole->get();
  if (const auto* real = node.as_floating_point()) to.value = real->get();
  if (const auto* flag = node.as_boolean()) to.value = flag->get();
  if (const auto* table = node.as_table()) to.value = convert_table(*table);
  if (const auto* array = node.as_array()) {
    TomlArray items;
    for (const toml::node& item : *array) items.push_back(convert(item));
    to.value = std::move(items);
  }
  return to;
}

template <class... F>
struct Overloaded : F... {
  using F::operator()...;
};
template <class... F>
Overloaded(F...) -> Overloaded<F...>;

std::string write(const TomlValue& value) {
  return std::visit(Overloaded{[](const TomlDate&) -> std::string { return "a date or time"; },
                               [](const std::string& text) { return toml_string(text.substr(0, 100)); },
                               [](std::int64_t whole) { return std::to_string(whole); },
                               [](double real) { return toml_number(real); },
                               [](bool flag) -> std::string { return flag ? "true" : "false"; },
                               [](const TomlTable&) -> std::string { return "{...}"; },
                               [](const TomlArray& items) {
                                 std::string text = "[";
                                 for (std::size_t i = 0; i < std::min<std::size_t>(items.size(), 8); ++i) {
                                   text += (i ? ", " : "") + write(items[i]);
                                 }
                                 return text + (items.size() > 8 ? ", ...]" : "]");
                               }},
                    value.value);
}

}  // namespace

std::string TomlValue::written() const {
  const std::string text = write(*this);
  return text.size() > 200 ? text.substr(0, 197) + "..." : text;
}

std::string TomlValue::kind() const {
  static constexpr const char* names[] = {"a date or time", "a text", "a whole number", "a number",
                                          "true or false",  "a list", "a table"};
  return names[value.index()];
}

TomlTable parse_toml(std::string_view text, const std::string& file_name) {
  constexpr std::size_t largest =
      1 << 20;  // a scenario is a few kB; the reader's memory grows with its input
  if (text.size() > largest) {
    throw InputError(fmt::format("{}: {} bytes are too many for a TOML file, at most {}", file_name,
                                 text.size(), largest));
  }
  try {
    return convert_table(toml::parse(text, std::string_view(file_name)));
  } catch (const toml::parse_error& error) {
    throw InputError(
        fmt::format("{}:{}: not valid TOML: {}", file_name, line_of(error.source()), error.description()));
  }
}

std::string toml_string(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      quoted += '\\';
      quoted += c;
    } else if (byte < 0x20 || byte == 0x7f) {
      quoted += fmt::format("\\u{:04X}", byte);
    } else {
      quoted += c;
    }
  }
  return quoted + '"';
}

std::string toml_number(double value) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
  std::string text = fmt::format("{}", value);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

}  // namespace incognita
