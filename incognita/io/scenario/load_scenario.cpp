#include "incognita/io/scenario/load_scenario.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <system_error>

#include "incognita/io/calibrations/read_calibration.hpp"
#include "incognita/io/formats/files.hpp"
#include "incognita/io/recordings/camera_of_recording.hpp"
#include "incognita/io/scenario/renamed_settings.hpp"
#include "incognita/io/scenario/scenario_checks.hpp"
#include "incognita/io/scenario/scenario_file.hpp"
#include "incognita/io/scenario/scenario_tree.hpp"
#include "incognita/io/scenario/setting_reader.hpp"
#include "incognita/io/scenario/unknown_setting.hpp"
#include "incognita/math/nearest_name.hpp"
#include "incognita/messages/errors.hpp"

namespace incognita {
namespace {

constexpr std::size_t largest_scenario = 1 << 20;
constexpr const char* camera_file = "camera.file";

std::filesystem::path find_scenario(const std::string& path_or_name) {
  const std::vector<std::string> names = embedded_scenarios();
  if (std::find(names.begin(), names.end(), path_or_name) != names.end()) {
    return std::filesystem::path(embedded_root) / (path_or_name + ".toml");
  }
  const std::filesystem::path path(path_or_name);
  std::error_code ignored;
  if (std::filesystem::exists(path, ignored)) return path;
  const std::string meant = nearest_name(path.stem().string(), names);
  throw InputError(
      fmt::format("{}: no such scenario file, nor a built-in scenario; built in are: {}; the nearest is {}",
                  path_or_name, fmt::join(names, ", "), meant));
}

/// The values given in a file and on the command line, and what is wrong with their form.
struct Given {
  GivenValues values;
  std::vector<std::string> problems = {};
  std::map<std::string, std::string> empty_sections = {};  ///< their lines
  int overrides = 0;

  void read_file_of(const std::filesystem::path& path) {
    read_text(read_file(path, largest_scenario), shown(path));
  }

  void read_text(const std::string& text, const std::string& file) {
    for (const TomlEntry& section : parse_toml(text, file)) {
      const std::string at = fmt::format("{}:{}", file, section.line);
      const auto* table = std::get_if<TomlTable>(&section.value.value);
      if (section.key.empty())
        problems.push_back(at + ": the name is empty; a section is written [name]");
      else if (table)
        read_section(section.key, *table, file, at);
      else
        problems.push_back(fmt::format("{}: {} = {}: must be a section, written [{}]", at, section.key,
                                       section.value.written(), section.key));
    }
  }

  void read_section(const std::string& name, const TomlTable& table, const std::string& file,
                    const std::string& at) {
    if (table.empty()) empty_sections[name] = at;
    for (const TomlEntry& entry : table) {
      const std::string source = fmt::format("{}:{}", file, entry.line);
      if (entry.key.empty())
        problems.push_back(
            fmt::format("{}: the name is empty; a setting of [{}] is written name = value", source, name));
      else
        values[name + "." + entry.key].push_back({entry.value, source, at});
    }
  }

  void override_with(const std::string& key, const std::string& value, const std::string& source) {
    values[key].push_back({value, source, "", ++overrides});
  }

  void read_set(const std::string& set) {
    const std::size_t equals = set.find('=');
    const std::string key = set.substr(0, equals);
    const std::size_t point = key.find('.');
    if (equals == std::string::npos || point == std::string::npos || point == 0 || point + 1 == key.size())
      problems.push_back(fmt::format("--set: `{}` must be written section.name=value", set));
    else
      override_with(key, set.substr(equals + 1), "--set");
  }

  /// Refuses settings with former names, and takes their values by the new ones: choices among them decide which
  /// other settings there are.
  void refuse_former_names() {
    for (auto at = values.begin(); at != values.end();) {
      const std::vector<std::string> now = new_keys(at->first);
      if (now.empty()) {
        ++at;
        continue;
      }
      problems.push_back(
          fmt::format("{}: `{}` is now `{}`", at->second.back().source, at->first, fmt::join(now, "` or `")));
      for (GivenValue& value : at->second) value.is_renamed = true;
      for (const std::string& key : now) values.emplace(key, at->second);
      at = values.erase(at);
    }
  }
};

bool is_empty_text(const GivenValue& given) {
  if (const auto* typed = std::get_if<std::string>(&given.value))
    return typed->empty() || *typed == "\"\"" || *typed == "''";
  const auto* text = std::get_if<std::string>(&std::get<TomlValue>(given.value).value);
  return text && text->empty();
}

/// What else is given of [camera] beside a calibration file of the same place: nothing is. A file of the command line
/// replaces the [camera] of the scenario.
void let_calibration_replace_camera(Given& given, std::vector<std::string>& notes) {
  const auto file = given.values.find(camera_file);
  if (file == given.values.end()) return;
  if (is_empty_text(
          file->second.back())) {  // as if it were not given: a recording then has its own calibration
    given.values.erase(file);
    return;
  }
  const GivenValue calibration = file->second.back();
  for (auto at = given.values.begin(); at != given.values.end();) {
    const auto& [key, values] = *at;
    const bool stays = section_of(key) != "camera" || key == camera_file || values.back().order > 0;
    if (stays) {
      ++at;
      continue;
    }
    if (calibration.order > 0)
      notes.push_back(fmt::format("{} ({}) is left out: camera.file ({}) replaces it", key,
                                  values.back().source, calibration.source));
    else
      given.problems.push_back(
          fmt::format("{}: {}: the camera is that of camera.file ({}); remove one of the two",
                      values.back().source, key, calibration.source));
    at = given.values.erase(at);
  }
}

/// The settings in the order of the first of their section.
std::vector<SettingInForce> by_section(std::vector<SettingInForce> settings) {
  std::vector<std::string> sections;
  for (const SettingInForce& s : settings) sections.push_back(section_of(s.key));
  const auto rank = [&](const SettingInForce& s) {
    return std::find(sections.begin(), sections.end(), section_of(s.key)) - sections.begin();
  };
  std::stable_sort(settings.begin(), settings.end(),
                   [&](const auto& a, const auto& b) { return rank(a) < rank(b); });
  return settings;
}

/// Throws InputError with every problem, so that a file can be repaired in one go.
void refuse(const std::vector<std::string>& problems) {
  if (!problems.empty()) throw InputError(fmt::format("{}", fmt::join(problems, "\n")));
}

/// `notes`: what of a calibration file is not used.
std::optional<FoundCamera> find_camera(const Scenario& scenario, const std::filesystem::path& file,
                                       std::vector<std::string>& notes) {
  if (scenario.camera.file.empty()) return camera_of_recording(scenario, file);
  const std::filesystem::path path =
      find_named_file(file, scenario.camera.file, SearchedPlaces::working_folder_too);
  const CalibrationFile calibration = read_calibration_file(
      path,
      {.camera = "",
       .size_remedy =
           "convert it with `incognita calibrate --convert FILE --image-size WIDTHxHEIGHT --out camera.toml`"});
  check_calibrated(calibration.calibrated);
  for (const std::string& note : calibration.notes) notes.push_back(shown(path) + ": " + note);
  return FoundCamera{calibration.calibrated.camera, "as " + shown(path)};
}

void read(LoadedScenario& loaded, Given given) {
  given.refuse_former_names();
  std::vector<std::string> replaced;
  let_calibration_replace_camera(given, replaced);
  SettingReader reader(given.values);
  read_settings(reader, loaded.scenario,
                [&](const Scenario& scenario) { return find_camera(scenario, loaded.file, replaced); });
  std::vector<std::string>& problems = given.problems;
  for (std::string& problem : explained_problems(given.values, reader))
    problems.push_back(std::move(problem));
  for (std::string& problem : explain_unknown(given.values, reader)) problems.push_back(std::move(problem));
  for (const auto& [section, at] : given.empty_sections)
    if (std::string problem = explain_empty_section(section, at, reader); !problem.empty())
      problems.push_back(std::move(problem));
  refuse(problems);
  loaded.settings = by_section(reader.settings());
  for (const SettingInForce& setting : loaded.settings) loaded.sources[setting.key] = setting.source;
  for (const auto& [order, line] : reader.overrides()) loaded.overrides.push_back(line);
  for (const LeftOut& one : left_out_by_command_line(given.values, reader))
    loaded.overrides.push_back(one.note);
  loaded.overrides.insert(loaded.overrides.end(), replaced.begin(), replaced.end());
  for (const Contradiction& found : find_contradictions(loaded.scenario)) {
    const auto setting = std::find_if(loaded.settings.begin(), loaded.settings.end(),
                                      [&](const SettingInForce& s) { return s.key == found.key; });
    if (setting == loaded.settings.end())
      throw std::logic_error("a check names " + found.key + ", which this scenario does not have");
    problems.push_back(fmt::format("{}: {} = {}: {}", setting->source, found.key, setting->value, found.why));
  }
  refuse(problems);
}

/// Replaces control characters, so that a comment stays on its line whatever a file is called.
std::string one_line(std::string text) {
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  }
  return text;
}

/// Files beside the scenario are written with their full path, so that the written scenario can be moved.
std::string written_for_elsewhere(const SettingInForce& setting, const LoadedScenario& loaded) {
  const bool names_recording = setting.key == "recording.folder";
  if (!(setting.names_file || names_recording) || is_embedded(loaded.file)) return setting.value;
  const auto name = std::get<std::string>(value_of_toml(setting.value).value);
  const std::filesystem::path beside = loaded.file.parent_path() / name;
  std::error_code ignored;
  if (name.empty() || !std::filesystem::exists(beside, ignored)) return setting.value;
  return toml_string(std::filesystem::absolute(beside).lexically_normal().string());
}

}  // namespace

LoadedScenario load_scenario(const std::string& path_or_name, std::span<const std::string> sets,
                             std::span<const Flag> flags) {
  LoadedScenario loaded;
  loaded.file = find_scenario(path_or_name);
  loaded.name = loaded.file.stem().string();
  Given given;
  given.read_file_of(loaded.file);
  for (const std::string& set : sets) given.read_set(set);
  for (const Flag& flag : flags) given.override_with(flag.key, flag.value, flag.source);
  read(loaded, std::move(given));
  return loaded;
}

std::string replay_toml(const LoadedScenario& live, const std::string& recording) {
  LoadedScenario replay = live;
  std::erase_if(replay.settings, [](const SettingInForce& s) { return section_of(s.key) == "live"; });
  for (SettingInForce& setting : replay.settings)
    if (setting.key == "world.type") setting.value = toml_string("recording");
  const auto given = [](const std::string& key, const std::string& value) {
    SettingInForce setting;
    setting.key = key, setting.value = toml_string(value), setting.source = "the live run";
    return setting;
  };
  replay.settings.push_back(given("recording.folder", recording));
  replay.settings.push_back(given("recording.format", "tum"));
  return effective_toml(replay);
}

LoadedScenario load_scenario_text(const std::string& text, const std::string& source, const std::string& name,
                                  const std::filesystem::path& file, std::span<const std::string> sets,
                                  std::span<const Flag> flags) {
  LoadedScenario loaded;
  loaded.file = file;
  loaded.name = name;
  Given given;
  given.read_text(text, source);
  for (const std::string& set : sets) given.read_set(set);
  for (const Flag& flag : flags) given.override_with(flag.key, flag.value, flag.source);
  read(loaded, std::move(given));
  if (sets.empty() && flags.empty()) loaded.settings_of_repeated_run = text;
  return loaded;
}

std::string effective_toml(const LoadedScenario& loaded) {
  if (!loaded.settings_of_repeated_run.empty()) return loaded.settings_of_repeated_run;
  std::string text =
      fmt::format("# incognita {}: every setting in force, with its source and unit.\n# Scenario {}, {}\n",
                  INCOGNITA_VERSION, one_line(loaded.name), one_line(shown(loaded.file)));
  std::string section;
  for (const SettingInForce& setting : loaded.settings) {
    if (setting.key == camera_file)
      continue;  // its values follow, so that the scenario stands without the file
    if (section_of(setting.key) != section) {
      section = section_of(setting.key);
      text += fmt::format("\n[{}]\n", section);
    }
    text += fmt::format("{} = {}  # {}; {}{}\n", name_in_section(setting.key),
                        written_for_elsewhere(setting, loaded), one_line(setting.source),
                        setting.unit.empty() ? "" : setting.unit + "; ", setting.help);
  }
  return text;
}

}  // namespace incognita
