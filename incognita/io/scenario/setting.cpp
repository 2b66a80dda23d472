#include "incognita/io/scenario/setting.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "incognita/math/nearest_name.hpp"

namespace incognita {
namespace {

void need_allowed(const Setting& setting, double number) {
  const Limits& limits = setting.limits;
  if (!std::isfinite(number)) throw BadValue{"must be finite"};
  const bool inside =
      (limits.more_than_least ? number > limits.least : number >= limits.least) && number <= limits.most;
  const bool parity = !limits.odd || std::fmod(number, 2.0) != 0.0;
  if (!inside || !parity) throw BadValue{"must be " + setting.allowed()};
}

BadValue wrong_kind(const Setting& setting, const TomlValue& value) {
  const std::string allowed = setting.allowed();
  return {fmt::format("must be {}{}, and is {}", setting.kind(), allowed.empty() ? "" : ", " + allowed,
                      value.kind())};
}

template <class T>
const T& get(const Setting& setting, const TomlValue& value) {
  if (const auto* held = std::get_if<T>(&value.value)) return *held;
  throw wrong_kind(setting, value);
}

std::size_t index_of_word(const Setting& setting, const std::string& text) {
  const auto at = std::find(setting.words.begin(), setting.words.end(), text);
  if (at == setting.words.end()) {
    const std::string nearest = setting.words.size() > 1
                                    ? fmt::format("; the nearest is `{}`", nearest_name(text, setting.words))
                                    : "";
    throw BadValue{fmt::format("must be {}{}", setting.allowed(), nearest)};
  }
  return static_cast<std::size_t>(at - setting.words.begin());
}

void set(const Choice& field, const Setting& setting, const TomlValue& value) {
  field.choose(index_of_word(setting, get<std::string>(setting, value)));
}

void set(std::string* field, const Setting& setting, const TomlValue& value) {
  const auto& text = get<std::string>(setting, value);
  if (!setting.words.empty()) index_of_word(setting, text);
  *field = text;
}

void set(bool* field, const Setting& setting, const TomlValue& value) { *field = get<bool>(setting, value); }

void set(std::int64_t* field, const Setting& setting, const TomlValue& value) {
  const std::int64_t whole = get<std::int64_t>(setting, value);
  need_allowed(setting, static_cast<double>(whole));
  *field = whole;
}

void set(int* field, const Setting& setting, const TomlValue& value) {
  std::int64_t whole = *field;
  set(&whole, setting, value);
  if (whole < std::numeric_limits<int>::min() || whole > std::numeric_limits<int>::max())
    throw BadValue{"must fit in 32 bits"};
  *field = static_cast<int>(whole);
}

void set(double* field, const Setting& setting, const TomlValue& value) {
  const auto* whole = std::get_if<std::int64_t>(&value.value);
  const double number = whole ? static_cast<double>(*whole) : get<double>(setting, value);
  need_allowed(setting, number);
  *field = number;
}

template <int size>
void set(Eigen::Matrix<double, size, 1>* field, const Setting& setting, const TomlValue& value) {
  const auto& items = get<TomlArray>(setting, value);
  if (items.size() != size) throw wrong_kind(setting, value);
  Eigen::Matrix<double, size, 1> vector;
  for (int i = 0; i < size; ++i) set(&vector[i], setting, items[i]);
  *field = vector;
}

template <class Item>
void set(std::vector<Item>* field, const Setting& setting, const TomlValue& value) {
  const auto& items = get<TomlArray>(setting, value);
  std::vector<Item> list(items.size());
  for (std::size_t i = 0; i < list.size(); ++i) set(&list[i], setting, items[i]);
  *field = list;
}

std::string write(const std::string* text) { return toml_string(*text); }
std::string write(const int* whole) { return std::to_string(*whole); }
std::string write(const std::int64_t* whole) { return std::to_string(*whole); }
std::string write(const double* real) { return toml_number(*real); }
std::string write(const bool* answer) { return *answer ? "true" : "false"; }

template <int size>
std::string write(const Eigen::Matrix<double, size, 1>* vector);

std::string in_brackets(const auto& items) {
  std::string text = "[";
  for (const auto& item : items) text += (text.size() > 1 ? ", " : "") + write(&item);
  return text + "]";
}
template <int size>
std::string write(const Eigen::Matrix<double, size, 1>* vector) {
  return in_brackets(*vector);
}
template <class Item>
std::string write(const std::vector<Item>* list) {
  return in_brackets(*list);
}

}  // namespace

std::string Setting::allowed() const {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i)
    text += (i == 0 ? "`" : i + 1 == words.size() ? " or `" : ", `") + words[i] + "`";
  if (!words.empty()) return text;
  if (limits.odd) text = "odd, ";
  const bool low = std::isfinite(limits.least), high = std::isfinite(limits.most);
  if (low && high)
    return fmt::format("{}{}{} to {}", text, limits.more_than_least ? "more than " : "", limits.least,
                       limits.most);
  if (low)
    return fmt::format("{}{} {}", text, limits.more_than_least ? "more than" : "at least", limits.least);
  return high ? fmt::format("{}at most {}", text, limits.most) : "";
}

std::string Setting::written() const {
  if (const auto* choice = std::get_if<Choice>(&field)) return toml_string(words.at(choice->index()));
  return std::visit(
      [](const auto& value) -> std::string {
        if constexpr (requires { write(value); }) return write(value);
        return "";
      },
      field);
}

std::string Setting::kind() const {
  static constexpr const char* names[] = {"a text",
                                          "a whole number",
                                          "a whole number",
                                          "a number",
                                          "true or false",
                                          "a list of two numbers",
                                          "a list of three numbers",
                                          "a list of numbers",
                                          "a list of [x, y]",
                                          "a list of [x, y, z]",
                                          "a text"};
  return names[field.index()];
}

void assign(const Setting& setting, const TomlValue& value) {
  std::visit([&](const auto& field) { set(field, setting, value); }, setting.field);
}

void assign_text(const Setting& setting, std::string_view text) {
  const bool is_text = setting.kind() == "a text";
  const bool quoted = text.size() >= 2 && (text.front() == '"' || text.front() == '\'');
  if (is_text && !quoted) return assign(setting, TomlValue{std::string(text), 0});
  TomlValue value;
  try {
    value = value_of_toml(std::string(text));
  } catch (const InputError&) {
    throw BadValue{fmt::format("must be {}", setting.kind())};
  }
  assign(setting, value);
}

TomlValue value_of_toml(const std::string& written) {
  if (written.find_first_of("\n\r#") == std::string::npos || written.starts_with('"')) {
    TomlTable table = parse_toml("value = " + written, "");
    if (table.size() == 1) return std::move(table.front().value);
  }
  throw InputError(written + ": is no value");
}

std::string section_of(const std::string& key) { return key.substr(0, key.find('.')); }

std::string name_in_section(const std::string& key) { return key.substr(key.find('.') + 1); }

}  // namespace incognita
