#include "incognita/io/formats/system_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <system_error>
#include <utility>

#include "incognita/analysis/systems/system_check.hpp"
#include "incognita/io/formats/embedded.hpp"
#include "incognita/io/formats/files.hpp"
#include "incognita/io/formats/toml_value.hpp"
#include "incognita/math/nearest_name.hpp"
#include "incognita/messages/errors.hpp"

namespace incognita {
namespace {

constexpr std::size_t largest_system = 1 << 20;
constexpr std::size_t longest_text = 400;

SourceLocation place_of(const TomlEntry& entry) { return {entry.line, entry.column}; }
SourceLocation place_of(const TomlValue& value) { return {value.line, value.column}; }

/// The function that reads the entry of a key.
using Reader = std::function<void(const TomlEntry&)>;
using Readers = std::vector<std::pair<std::string, Reader>>;

/// Calls the reader of each key of a table; throws for an unknown key.
void read_keys(const TomlTable& table, const std::string& section, const Readers& readers) {
  for (const TomlEntry& entry : table) {
    const auto reader =
        std::find_if(readers.begin(), readers.end(), [&](const auto& r) { return r.first == entry.key; });
    if (reader == readers.end()) {
      std::vector<std::string> names;
      for (const auto& [name, reads] : readers) names.push_back(name);
      throw SystemError(place_of(entry),
                        fmt::format("there is no {} {}; the nearest is `{}`",
                                    section.empty() ? "section or key" : "`" + section + "` key",
                                    quoted_name(entry.key), nearest_name(entry.key, names)));
    }
    reader->second(entry);
  }
}

[[noreturn]] void refuse_as(const TomlEntry& entry, const std::string& wanted, const std::string& found) {
  throw SystemError(place_of(entry.value),
                    fmt::format("{} must be {}, and {}", quoted_name(entry.key), wanted, found));
}

[[noreturn]] void refuse(const TomlEntry& entry, const std::string& wanted) {
  refuse_as(entry, wanted, "is " + entry.value.kind());
}

const TomlTable& section(const TomlEntry& entry) {
  if (const auto* table = std::get_if<TomlTable>(&entry.value.value)) return *table;
  refuse(entry, "a section");
}

std::string text(const TomlEntry& entry) {
  const auto* words = std::get_if<std::string>(&entry.value.value);
  if (!words) refuse(entry, "a text");
  const bool printable = std::none_of(
      words->begin(), words->end(), [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; });
  if (words->empty() || words->size() > longest_text || !printable)
    refuse_as(entry, fmt::format("one line of 1 to {} characters", longest_text),
              words->empty()                                      ? "is empty"
              : words->find_first_of("\r\n") != std::string::npos ? "has a line break"
              : !printable                                        ? "has a character that cannot be displayed"
                                                                  : fmt::format("has {}", words->size()));
  return *words;
}

double number(const TomlValue& value, const std::string& key) {
  const auto* whole = std::get_if<std::int64_t>(&value.value);
  const auto* real = std::get_if<double>(&value.value);
  if ((!whole && !real) || (real && !std::isfinite(*real)))
    throw SystemError(place_of(value), fmt::format("{} must be a finite number, and is {}", quoted_name(key),
                                                   value.written()));
  return whole ? static_cast<double>(*whole) : *real;
}

double positive(const TomlEntry& entry) {
  const double value = number(entry.value, entry.key);
  if (value <= 0)
    throw SystemError(place_of(entry.value), fmt::format("{} must be more than 0, and is {}",
                                                         quoted_name(entry.key), entry.value.written()));
  return value;
}

std::vector<NamedNumber> numbers(const TomlEntry& entry) {
  std::vector<NamedNumber> all;
  for (const TomlEntry& one : section(entry))
    all.push_back({one.key, place_of(one), number(one.value, one.key)});
  return all;
}

std::vector<NamedRange> ranges(const TomlEntry& entry) {
  std::vector<NamedRange> all;
  for (const TomlEntry& one : section(entry)) {
    const auto* ends = std::get_if<TomlArray>(&one.value.value);
    if (!ends) refuse(one, "a range, [lowest, highest]");
    if (ends->size() != 2)
      refuse_as(one, "a range, [lowest, highest]",
                ends->size() == 1 ? "has 1 entry" : fmt::format("has {} entries", ends->size()));
    all.push_back({one.key, place_of(one), number((*ends)[0], one.key), number((*ends)[1], one.key)});
  }
  return all;
}

/// A string, or a number.
ExpressionText expression(const TomlEntry& entry) {
  const TomlValue& value = entry.value;
  if (const auto* words = std::get_if<std::string>(&value.value))
    return {*words, {value.line, value.text_column}};
  const bool whole = std::holds_alternative<std::int64_t>(value.value);
  if (!whole && !std::holds_alternative<double>(value.value)) refuse(entry, "an expression in quotes");
  number(value, entry.key);
  return {value.written(), place_of(value)};
}

NamedExpression named_expression(const TomlEntry& entry) {
  return {entry.key, place_of(entry), expression(entry)};
}

std::vector<NamedExpression> expressions(const TomlTable& table) {
  std::vector<NamedExpression> all;
  for (const TomlEntry& one : table) all.push_back(named_expression(one));
  return all;
}

/// An expression, or a table with an expression and its standard deviation.
MeasurementText measurement(const TomlEntry& entry) {
  MeasurementText one{entry.key, place_of(entry), {}, 1};
  const auto* table = std::get_if<TomlTable>(&entry.value.value);
  if (!table) {
    one.expression = expression(entry);
    return one;
  }
  bool has_expression = false;
  read_keys(*table, entry.key,
            {{"is",
              [&](const TomlEntry& is) {
                one.expression = expression(is);
                has_expression = true;
              }},
             {"sigma", [&](const TomlEntry& sigma) { one.sigma = positive(sigma); }}});
  if (!has_expression)
    throw SystemError(
        place_of(entry),
        fmt::format("measurement {} has no expression; write {{ is = \"...\" }}", quoted_name(entry.key)));
  return one;
}

std::vector<MeasurementText> measurements(const TomlEntry& entry) {
  std::vector<MeasurementText> all;
  for (const TomlEntry& one : section(entry)) all.push_back(measurement(one));
  return all;
}

std::vector<SparseRow> rows(const TomlEntry& entry) {
  std::vector<SparseRow> all;
  for (const TomlEntry& row : section(entry))
    all.push_back({row.key, place_of(row), expressions(section(row))});
  return all;
}

std::vector<DirectionText> directions(const TomlEntry& entry) {
  std::vector<DirectionText> all;
  for (const TomlEntry& one : section(entry)) {
    DirectionText direction{one.key, place_of(one), {}, {}};
    for (const TomlEntry& part : section(one)) {
      if (part.key == "landmark") {
        direction.landmark = expressions(section(part));
      } else {
        direction.vehicle.push_back(named_expression(part));
      }
    }
    all.push_back(std::move(direction));
  }
  return all;
}

/// Directions of the landmarks only, without a vehicle part.
std::vector<DirectionText> landmark_directions(const TomlEntry& entry) {
  std::vector<DirectionText> all;
  for (const TomlEntry& one : section(entry))
    all.push_back({one.key, place_of(one), {}, expressions(section(one))});
  return all;
}

std::vector<MotionText> motions(const TomlEntry& entry) {
  std::vector<MotionText> all;
  for (const TomlEntry& one : section(entry)) {
    MotionText motion{one.key, place_of(one), {}, {}};
    for (const TomlEntry& part : section(one)) {
      if (part.key == "draw") {
        motion.draws = ranges(part);
      } else {
        motion.assignments.push_back(named_expression(part));
      }
    }
    all.push_back(std::move(motion));
  }
  return all;
}

std::vector<DisturbedState> state_names(const TomlEntry& entry) {
  const auto* items = std::get_if<TomlArray>(&entry.value.value);
  std::vector<DisturbedState> names;
  for (std::size_t i = 0; items && i < items->size(); ++i) {
    const TomlValue& item = (*items)[i];
    const auto* name = std::get_if<std::string>(&item.value);
    if (!name) break;
    names.push_back({*name, {item.line, item.column}});
  }
  if (!items || names.size() != items->size())
    throw SystemError(place_of(entry.value),
                      "`disturbed` must be a list of the vehicle's states, such as [\"vx\"], and is " +
                          entry.value.written());
  return names;
}

class SystemReader {
 public:
  SystemText read(const TomlTable& top) {
    Readers readers = head();
    for (const auto& more : {body(), parts()}) readers.insert(readers.end(), more.begin(), more.end());
    read_keys(top, "", readers);
    if (system_.name.empty())
      throw SystemError({}, "the system has no name; write name = \"...\" at the top");
    if (system_.title.empty()) system_.title = system_.name;
    return std::move(system_);
  }

 private:
  Readers head() {
    return {{"name", [&](const TomlEntry& e) { system_.name = text(e); }},
            {"title", [&](const TomlEntry& e) { system_.title = text(e); }},
            {"source", [&](const TomlEntry& e) { system_.source = text(e); }},
            {"representation", [&](const TomlEntry& e) { read_representation(e); }},
            {"segment_duration_s", [&](const TomlEntry& e) { system_.segment_duration_s = positive(e); }},
            {"disturbed", [&](const TomlEntry& e) { system_.disturbed = state_names(e); }}};
  }

  Readers body() {
    Readers readers = block(system_.vehicle);
    readers.push_back({"parameters", [&](const TomlEntry& e) { system_.parameters = numbers(e); }});
    readers.push_back({"inputs", [&](const TomlEntry& e) { system_.inputs = ranges(e); }});
    return readers;
  }

  Readers parts() {
    return {{"landmark", [&](const TomlEntry& e) { read_landmark(e); }},
            {"anchor", [&](const TomlEntry& e) { read_anchor(e); }},
            {"motion", [&](const TomlEntry& e) { system_.motions = motions(e); }},
            {"directions", [&](const TomlEntry& e) { system_.directions = directions(e); }},
            {"error", [&](const TomlEntry& e) { read_error(e); }}};
  }

  static Readers block(BlockText& block) {
    return {{"states", [&](const TomlEntry& e) { block.states = expressions(section(e)); }},
            {"region", [&](const TomlEntry& e) { block.region = ranges(e); }},
            {"definitions", [&](const TomlEntry& e) { block.definitions = expressions(section(e)); }},
            {"measurements", [&](const TomlEntry& e) { block.measurements = measurements(e); }}};
  }

  void read_representation(const TomlEntry& entry) {
    system_.representation = text(entry);
    if (system_.representation != "world" && system_.representation != "relative")
      throw SystemError(place_of(entry.value), "`representation` must be `world` or `relative`, and is " +
                                                   quoted_name(system_.representation));
  }

  void read_landmark(const TomlEntry& entry) {
    BlockText& landmark = system_.landmark.emplace();
    Readers readers = block(landmark);
    readers.push_back(
        {"directions", [&](const TomlEntry& e) { system_.landmark_directions = landmark_directions(e); }});
    readers.push_back({"error", [&](const TomlEntry& e) {
                         Readers of_error = error_rows(landmark);
                         of_error.push_back({"directions", [&](const TomlEntry& d) {
                                               form().landmark_directions = landmark_directions(d);
                                             }});
                         read_keys(section(e), "landmark.error", of_error);
                       }});
    read_keys(section(entry), "landmark", readers);
  }

  void read_anchor(const TomlEntry& entry) {
    BlockText& anchor = system_.anchor.emplace();
    read_keys(section(entry), "anchor",
              {{"constants", [&](const TomlEntry& e) { anchor.region = ranges(e); }},
               {"definitions", [&](const TomlEntry& e) { anchor.definitions = expressions(section(e)); }},
               {"measurements", [&](const TomlEntry& e) { anchor.measurements = measurements(e); }},
               {"error", [&](const TomlEntry& e) {
                  read_keys(section(e), "anchor.error", {{"H", [&](const TomlEntry& h) {
                                                            form();
                                                            anchor.error_H = rows(h);
                                                          }}});
                }}});
  }

  void read_error(const TomlEntry& entry) {
    Readers readers = error_rows(system_.vehicle);
    readers.push_back({"source", [&](const TomlEntry& e) { form().source = text(e); }});
    readers.push_back({"states", [&](const TomlEntry& e) { read_error_names(e); }});
    readers.push_back({"directions", [&](const TomlEntry& e) { form().directions = directions(e); }});
    read_keys(section(entry), "error", readers);
  }

  Readers error_rows(BlockText& block) {
    const auto reads = [&](std::vector<SparseRow>& to) {
      return [&](const TomlEntry& e) {
        form();
        to = rows(e);
      };
    };
    return {{"F", reads(block.error_F)}, {"H", reads(block.error_H)}};
  }

  void read_error_names(const TomlEntry& entry) {
    for (const TomlEntry& one : section(entry))
      form().names.push_back({one.key, place_of(one), {text(one), {one.value.line, one.value.text_column}}});
  }

  /// Any error setting makes the system one with an error form.
  ErrorFormText& form() {
    if (!system_.error_form) system_.error_form.emplace();
    return *system_.error_form;
  }

  SystemText system_;
};

std::string where(const std::string& file, SourceLocation location) {
  return location.line > 0 ? fmt::format("{}:{}:{}", file, location.line, location.column) : file;
}

const EmbeddedFile* find_built_in(const std::string& name) {
  for (const EmbeddedFile& file : embedded_systems()) {
    if (file.name == name + ".toml") return &file;
  }
  return nullptr;
}

SystemText read_built_in(const EmbeddedFile& file) { return read_system(file.bytes, std::string(file.name)); }

/// The built-in system, or its variant in the other representation.
SystemText load_built_in(const EmbeddedFile& file, const std::string& representation) {
  SystemText system = read_built_in(file);
  if (representation.empty() || system.representation == representation) return system;
  for (const std::string& name : {system.name, system.name + "-" + representation}) {
    const EmbeddedFile* other = find_built_in(name);
    if (!other) continue;
    if (SystemText found = read_built_in(*other); found.representation == representation) return found;
  }
  throw InputError(fmt::format("{} is built in with the representation `{}`, not `{}`", system.name,
                               system.representation, representation));
}

SystemText load_file(const std::string& path, const std::string& representation) {
  SystemText system = read_system(read_file(path, largest_system), path);
  if (representation.empty() || system.representation == representation) return system;
  throw InputError(fmt::format("{}: has the representation `{}`, not `{}`; use `{}`, or another file", path,
                               system.representation, representation, system.representation));
}

/// Replaces messages of the TOML library that contain its own type names.
std::string toml_problem(const std::string& reason) {
  const std::size_t at = reason.find("cannot redefine existing ");
  if (at == std::string::npos) return "not valid TOML: " + reason;
  const std::size_t open = reason.find('\'', at), close = reason.rfind('\'');
  const std::string name = open < close ? quoted_name(reason.substr(open + 1, close - open - 1)) : "";
  if (reason.find("table header") != std::string::npos)
    return fmt::format("not valid TOML: there is a {} already; write all of it in one place",
                       name.empty() ? "section of this name" : "section or key " + name);
  return fmt::format("not valid TOML: there is a key {}already in this section; keep one of them",
                     name.empty() ? "of this name " : name + " ");
}

/// Whether the name is meant as a path: built-in systems have plain names.
bool is_path(const std::string& name) {
  return name.find_first_of("/\\") != std::string::npos || name.ends_with(".toml");
}

}  // namespace

SystemText read_system(std::string_view text, const std::string& file_name) {
  try {
    SystemText system = SystemReader().read(parse_toml(text, file_name));
    system.file = file_name;
    check_system(system);
    return system;
  } catch (const TomlError& error) {
    throw InputError(
        fmt::format("{}: {}", where(file_name, {error.line, error.column}), toml_problem(error.reason)));
  } catch (const SystemError& error) {
    throw InputError(fmt::format("{}: {}", where(file_name, error.location), error.what()));
  }
}

std::vector<std::string> built_in_systems() {
  std::vector<std::string> names;
  for (const EmbeddedFile& file : embedded_systems())
    names.push_back(std::filesystem::path(file.name).stem().string());
  return names;
}

SystemText load_system(const std::string& name_or_path, const std::string& representation) {
  if (!representation.empty() && representation != "world" && representation != "relative")
    throw InputError("the representation must be `world` or `relative`, not " + quoted_name(representation));
  if (const EmbeddedFile* file = find_built_in(name_or_path)) return load_built_in(*file, representation);
  std::error_code ignored;
  if (std::filesystem::exists(name_or_path, ignored)) return load_file(name_or_path, representation);
  const std::vector<std::string> names = built_in_systems();
  if (is_path(name_or_path))
    throw InputError(fmt::format("{}: no such system file; built in, by their names alone, are: {}",
                                 name_or_path, fmt::join(names, ", ")));
  throw InputError(
      fmt::format("{}: no such system file, nor a built-in system; built in are: {}; the nearest is {}",
                  name_or_path, fmt::join(names, ", "), nearest_name(name_or_path, names)));
}

}  // namespace incognita
