#include "incognita/io/scenario/setting.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <type_traits>

#include "incognita/io/scenario/enum_words.hpp"
#include "incognita/math/nearest_name.hpp"
#include "incognita/messages/errors.hpp"

namespace incognita {
namespace {

std::optional<double> as_number(const TomlValue& value) {
  if (const auto* whole = std::get_if<std::int64_t>(&value.value)) return static_cast<double>(*whole);
  if (const auto* real = std::get_if<double>(&value.value)) return *real;
  return std::nullopt;
}

void need_allowed(const Allowed& allowed, double number) {
  if (!std::isfinite(number)) throw BadValue{"must be finite"};
  const bool inside =
      (allowed.more_than_least ? number > allowed.least : number >= allowed.least) && number <= allowed.most;
  const bool parity = !allowed.odd || std::fmod(number, 2.0) != 0.0;
  if (!inside || !parity) throw BadValue{"must be " + allowed.text()};
}

BadValue wrong_kind(const Setting& setting, const TomlValue& value) {
  const std::string allowed = setting.allowed.text();
  return {fmt::format("must be {}{}, and is {}", setting.kind(), allowed.empty() ? "" : ", " + allowed,
                      value.kind())};
}

double number_for(const Setting& setting, const TomlValue& value) {
  const std::optional<double> number = as_number(value);
  if (!number) throw wrong_kind(setting, value);
  need_allowed(setting.allowed, *number);
  return *number;
}

std::int64_t whole_for(const Setting& setting, const TomlValue& value) {
  const auto* whole = std::get_if<std::int64_t>(&value.value);
  if (!whole) throw wrong_kind(setting, value);
  need_allowed(setting.allowed, static_cast<double>(*whole));
  return *whole;
}

std::string text_for(const Setting& setting, const TomlValue& value) {
  const auto* text = std::get_if<std::string>(&value.value);
  if (!text) throw wrong_kind(setting, value);
  const auto& choices = setting.allowed.choices;
  if (!choices.empty() && std::find(choices.begin(), choices.end(), *text) == choices.end()) {
    throw BadValue{
        fmt::format("must be {}; the nearest is `{}`", setting.allowed.text(), nearest_name(*text, choices))};
  }
  return *text;
}

void set(std::string* field, const Setting& setting, const TomlValue& value) {
  *field = text_for(setting, value);
}

template <class Enum>
requires std::is_enum_v<Enum>
void set(Enum* field, const Setting& setting, const TomlValue& value) {
  const std::string text = text_for(setting, value);
  for (const auto& [known, word] : words_of(*field))
    if (text == word) *field = known;
}

void set(std::int64_t* field, const Setting& setting, const TomlValue& value) {
  *field = whole_for(setting, value);
}

void set(int* field, const Setting& setting, const TomlValue& value) {
  const std::int64_t whole = whole_for(setting, value);
  if (whole < std::numeric_limits<int>::min() || whole > std::numeric_limits<int>::max()) {
    throw BadValue{"must fit in 32 bits"};
  }
  *field = static_cast<int>(whole);
}

void set(double* field, const Setting& setting, const TomlValue& value) {
  *field = number_for(setting, value);
}

void set(Eigen::Vector3d* field, const Setting& setting, const TomlValue& value) {
  const auto* items = std::get_if<TomlArray>(&value.value);
  if (!items || items->size() != 3) throw wrong_kind(setting, value);
  Eigen::Vector3d vector;
  for (int i = 0; i < 3; ++i) vector[i] = number_for(setting, (*items)[i]);
  *field = vector;
}

void set(bool* field, const Setting& setting, const TomlValue& value) {
  const auto* answer = std::get_if<bool>(&value.value);
  if (!answer) throw wrong_kind(setting, value);
  *field = *answer;
}

void set(Eigen::Vector2d* field, const Setting& setting, const TomlValue& value) {
  const auto* items = std::get_if<TomlArray>(&value.value);
  if (!items || items->size() != 2) throw wrong_kind(setting, value);
  *field = {number_for(setting, (*items)[0]), number_for(setting, (*items)[1])};
}

template <class Item>
void set(std::vector<Item>* field, const Setting& setting, const TomlValue& value) {
  const auto* items = std::get_if<TomlArray>(&value.value);
  if (!items) throw wrong_kind(setting, value);
  std::vector<Item> list(items->size());
  for (std::size_t i = 0; i < list.size(); ++i) set(&list[i], setting, (*items)[i]);
  *field = list;
}

std::string write(const std::string* text) { return toml_string(*text); }
template <class Enum>
requires std::is_enum_v<Enum> std::string write(const Enum* choice) { return toml_string(word_of(*choice)); }
std::string write(const int* whole) { return std::to_string(*whole); }
std::string write(const std::int64_t* whole) { return std::to_string(*whole); }
std::string write(const double* real) { return toml_number(*real); }
std::string write(const Eigen::Vector3d* v) {
  return fmt::format("[{}, {}, {}]", toml_number(v->x()), toml_number(v->y()), toml_number(v->z()));
}

std::string write(const bool* answer) { return *answer ? "true" : "false"; }
std::string write(const Eigen::Vector2d* v) {
  return fmt::format("[{}, {}]", toml_number(v->x()), toml_number(v->y()));
}
template <class Item>
std::string write(const std::vector<Item>* list) {
  std::string text = "[";
  for (const Item& item : *list) text += (text.size() > 1 ? ", " : "") + write(&item);
  return text + "]";
}

std::string plain(double number) { return fmt::format("{}", number); }

}  // namespace

std::string Allowed::text() const {
  std::string text;
  for (std::size_t i = 0; i < choices.size(); ++i) {
    text += (i == 0 ? "`" : i + 1 == choices.size() ? " or `" : ", `") + choices[i] + "`";
  }
  if (!choices.empty()) return text;
  if (odd) text = "odd";
  const std::string space = text.empty() ? "" : ", ";
  const bool low = std::isfinite(least), high = std::isfinite(most);
  if (low && high) {
    return text + space +
           fmt::format("{}{} to {}", more_than_least ? "more than " : "", plain(least), plain(most));
  }
  if (low) return text + space + (more_than_least ? "more than " : "at least ") + plain(least);
  if (high) return text + space + "at most " + plain(most);
  return text;
}

std::string Setting::written() const {
  return std::visit([](const auto* value) { return write(value); }, field);
}

std::string Setting::kind() const {
  static constexpr const char* names[] = {"a text",
                                          "a whole number",
                                          "a whole number",
                                          "a number",
                                          "a list of three numbers",
                                          "true or false",
                                          "a list of two numbers",
                                          "a list of [x, y]",
                                          "a list of [x, y, z]",
                                          "a list of numbers"};
  return field.index() < std::size(names) ? names[field.index()] : names[0];  // enumerations are strings
}

void assign(const Setting& setting, const TomlValue& value) {
  std::visit([&](auto* target) { set(target, setting, value); }, setting.field);
}

void assign_text(const Setting& setting, std::string_view text) {
  const bool is_text = setting.kind() == "a text";
  const bool quoted = text.size() >= 2 && (text.front() == '"' || text.front() == '\'');
  if (is_text && !quoted) return assign(setting, TomlValue{std::string(text), 0});
  const BadValue unreadable{fmt::format("must be {}", setting.kind())};
  if (text.find_first_of("\n\r#") != std::string_view::npos) throw unreadable;
  TomlTable table;
  try {
    table = parse_toml("value = " + std::string(text), "");
  } catch (const InputError&) {
    throw unreadable;
  }
  if (table.size() != 1) throw unreadable;
  assign(setting, table.front().value);
}

}  // namespace incognita
