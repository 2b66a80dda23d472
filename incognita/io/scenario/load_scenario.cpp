#include "incognita/io/scenario/load_scenario.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

#include "incognita/io/formats/files.hpp"
#include "incognita/io/recordings/camera_of_recording.hpp"
#include "incognita/io/scenario/scenario_checks.hpp"
#include "incognita/io/scenario/settings.hpp"
#include "incognita/io/scenario/team_setting_list.hpp"
#include "incognita/math/nearest_name.hpp"
#include "incognita/messages/errors.hpp"

namespace incognita {
namespace {

constexpr std::size_t largest_scenario = 1 << 20;

std::string join(const std::vector<std::string>& parts, const char* between) {
  return fmt::format("{}", fmt::join(parts, between));
}

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
                  path_or_name, join(names, ", "), meant));
}

std::vector<std::string> sections(const std::vector<Setting>& settings) {
  std::vector<std::string> names;
  for (const Setting& setting : settings) {
    const std::string section = section_of(setting.key);
    if (names.empty() || names.back() != section) names.push_back(section);
  }
  return names;
}

std::vector<std::string> keys(const std::vector<Setting>& settings, const std::string& section = "") {
  std::vector<std::string> names;
  for (const Setting& setting : settings) {
    if (section.empty()) names.push_back(setting.key);
    if (section_of(setting.key) == section) names.push_back(name_in_section(setting.key));
  }
  return names;
}

/// Collects all errors, so that a file can be repaired in one go.
class Reader {
 public:
  explicit Reader(LoadedScenario& loaded) : loaded_(loaded), settings_(list_settings(loaded.scenario)) {
    for (const Setting& setting : settings_) loaded_.sources[setting.key] = "default";
  }

  void read_file_of(const std::filesystem::path& path) {
    const std::string file = shown(path);
    for (const TomlEntry& entry : parse_toml(read_file(path, largest_scenario), file))
      read_section(file, entry);
    default_association();
    default_gaze();
  }

  void override_with(const std::string& key, const std::string& value, const std::string& source) {
    const Setting* setting = find(key);
    if (!setting) {
      problems_.push_back(fmt::format("{}: there is no setting `{}`; the nearest is `{}`", source, key,
                                      nearest_name(key, keys(settings_))));
      return;
    }
    const std::string before = setting->written(), before_source = loaded_.sources[key];
    try {
      assign_text(*setting, value);
    } catch (const BadValue& bad) {
      problems_.push_back(fmt::format("{}: {} = {}: {}", source, key, value, bad.why));
      return;
    }
    loaded_.sources[key] = source;
    loaded_.overrides.push_back(
        fmt::format("{} = {} ({}) replaces {} ({})", key, setting->written(), source, before, before_source));
  }

  void problem(std::string text) { problems_.push_back(std::move(text)); }

  void check() {
    // A refused value leaves its default, with which the applicability of other settings could be misjudged.
    if (problems_.empty()) {
      default_association();
      default_gaze();
      apply_true_noise_defaults();
      take_camera_of_recording(loaded_);
      refuse_inapplicable();
    }
    if (problems_.empty()) {  // otherwise a contradiction may only follow from a refused value
      for (const Contradiction& found : find_contradictions(loaded_.scenario)) {
        const Setting* setting = find(found.key);
        problems_.push_back(fmt::format("{}: {} = {}: {}", loaded_.sources[found.key], found.key,
                                        setting->written(), found.why));
      }
    }
    if (!problems_.empty()) throw InputError(join(problems_, "\n"));
  }

 private:
  const Setting* find(const std::string& key) const {
    const auto it =
        std::find_if(settings_.begin(), settings_.end(), [&](const Setting& s) { return s.key == key; });
    return it == settings_.end() ? nullptr : &*it;
  }

  /// Point-landmark sensors provide identities by default. If not, gates are wide: the initial depth is a
  /// guess, and a gated re-detection would be initialized as a duplicate landmark.
  void default_association() {
    DataAssociationSettings usual;
    if (loaded_.scenario.run.world == "points") {
      usual.method = "known";
      usual.gate_probability = 0.9999;
      usual.initialization_probability = 0.99999999;
      usual.initialization_distance_m = 0;
    }
    DataAssociationSettings& now = loaded_.scenario.planar.association;
    const auto is_default = [&](const char* key) { return loaded_.sources.at(key) == "default"; };
    if (is_default("association.method")) now.method = usual.method;
    if (is_default("association.gate_probability")) now.gate_probability = usual.gate_probability;
    if (is_default("association.birth_probability"))
      now.initialization_probability = usual.initialization_probability;
    if (is_default("association.birth_distance_m"))
      now.initialization_distance_m = usual.initialization_distance_m;
  }

  /// The swinging gaze is not available with point landmarks (decision_checks.cpp).
  void default_gaze() {
    if (loaded_.sources.at("decision.gaze") != "default") return;
    const bool points = loaded_.scenario.run.world == "points";
    loaded_.scenario.decision.gaze = points ? DecisionSettings::Gaze::hold : DecisionSettings{}.gaze;
  }

  /// The true noises default to those of the filter.
  void apply_true_noise_defaults() {
    if (loaded_.scenario.run.world != "points") return;
    for (const auto& [truth, belief] : true_noise_defaults()) {
      if (loaded_.sources[truth] != "default") continue;
      try {
        assign_text(*find(truth), find(belief)->written());
        loaded_.sources[truth] = "as " + std::string(belief);
      } catch (const BadValue& bad) {
        problems_.push_back(fmt::format("{}: {} = {}: as {}, which follows it, it {}",
                                        loaded_.sources[belief], belief, find(belief)->written(), truth,
                                        bad.why));
      }
    }
  }

  /// Refuses settings of another sensor or vehicle, which would be ignored.
  void refuse_inapplicable() {
    for (const Setting& setting : settings_) {
      const std::string& source = loaded_.sources[setting.key];
      const bool is_set = source != "default" && !source.starts_with("as ");
      const std::string with = !is_set ? "" : inapplicable_reason(setting.key, loaded_.scenario);
      if (!with.empty())
        problems_.push_back(
            fmt::format("{}: {} = {}: means nothing with {}", source, setting.key, setting.written(), with));
    }
  }

  void read_section(const std::string& file, const TomlEntry& section) {
    const std::vector<std::string> names = sections(settings_);
    const std::string at = fmt::format("{}:{}", file, section.line);
    if (std::find(names.begin(), names.end(), section.key) == names.end()) {
      problems_.push_back(fmt::format("{}: there is no section `{}`; the nearest is `{}`", at, section.key,
                                      nearest_name(section.key, names)));
    } else if (const auto* table = std::get_if<TomlTable>(&section.value.value)) {
      for (const TomlEntry& entry : *table) read_setting(file, section.key, entry);
    } else {
      problems_.push_back(fmt::format("{}: {} = {}: must be a section, written [{}]", at, section.key,
                                      section.value.written(), section.key));
    }
  }

  void read_setting(const std::string& file, const std::string& section, const TomlEntry& entry) {
    const std::string at = fmt::format("{}:{}", file, entry.line), key = section + "." + entry.key;
    const Setting* setting = find(key);
    if (!setting) {
      problems_.push_back(fmt::format("{}: there is no setting `{}`; the nearest is `{}.{}`", at, key,
                                      section, nearest_name(entry.key, keys(settings_, section))));
      return;
    }
    try {
      assign(*setting, entry.value);
      loaded_.sources[key] = at;
    } catch (const BadValue& bad) {
      problems_.push_back(fmt::format("{}: {} = {}: {}", at, key, entry.value.written(), bad.why));
    }
  }

  LoadedScenario& loaded_;
  std::vector<Setting> settings_;
  std::vector<std::string> problems_;
};

/// Replaces control characters, so that a comment stays on its line whatever a file is called.
std::string one_line(std::string text) {
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  }
  return text;
}

/// Files beside the scenario are written with their full path, so that the written scenario can be moved.
std::string written_for_elsewhere(const Setting& setting, const LoadedScenario& loaded) {
  const bool names_file = setting.key == "start.target" || setting.key == "points.file" ||
                          setting.key == "path.file" || setting.key == "terrain.file";
  if (!names_file || is_embedded(loaded.file)) return setting.written();
  const std::string& name = *std::get<std::string*>(setting.field);
  const std::filesystem::path beside = loaded.file.parent_path() / name;
  if (name.empty() || !file_exists(beside)) return setting.written();
  return toml_string(std::filesystem::absolute(beside).lexically_normal().string());
}

}  // namespace

LoadedScenario load_scenario(const std::string& path_or_name, std::span<const std::string> sets,
                             std::span<const Flag> flags) {
  LoadedScenario loaded;
  loaded.file = find_scenario(path_or_name);
  loaded.name = loaded.file.stem().string();
  Reader reader(loaded);
  reader.read_file_of(loaded.file);
  for (const std::string& set : sets) {
    const std::size_t equals = set.find('=');
    if (equals == std::string::npos) {
      reader.problem(fmt::format("--set: `{}` must be written section.name=value", set));
    } else {
      reader.override_with(set.substr(0, equals), set.substr(equals + 1), "--set");
    }
  }
  for (const Flag& flag : flags) reader.override_with(flag.key, flag.value, flag.source);
  reader.check();
  return loaded;
}

std::string effective_toml(const LoadedScenario& loaded) {
  Scenario scenario = loaded.scenario;
  std::string text =
      fmt::format("# incognita {}: every setting in force, with its source and unit.\n# Scenario {}, {}\n",
                  INCOGNITA_VERSION, one_line(loaded.name), one_line(shown(loaded.file)));
  std::string section;
  for (const Setting& setting : settings_in_force(scenario)) {
    if (section_of(setting.key) != section) {
      section = section_of(setting.key);
      text += fmt::format("\n[{}]\n", section);
    }
    const auto source = loaded.sources.find(setting.key);
    text += fmt::format("{} = {}  # {}; {}{}\n", name_in_section(setting.key),
                        written_for_elsewhere(setting, loaded),
                        source == loaded.sources.end() ? "default" : one_line(source->second),
                        setting.unit.empty() ? "" : setting.unit + "; ", setting.help);
  }
  return text;
}

}  // namespace incognita
