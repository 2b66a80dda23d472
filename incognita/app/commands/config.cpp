#include "incognita/app/commands/config.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "incognita/app/console/print_message.hpp"
#include "incognita/app/loop/assemble.hpp"
#include "incognita/app/loop/assemble_ranges.hpp"
#include "incognita/app/loop/assemble_room_vehicle.hpp"
#include "incognita/app/loop/assemble_team.hpp"
#include "incognita/io/formats/files.hpp"
#include "incognita/io/recordings/camera_of_recording.hpp"
#include "incognita/io/recordings/recorded.hpp"
#include "incognita/io/recordings/recording.hpp"
#include "incognita/io/scenario/enum_words.hpp"
#include "incognita/io/scenario/load_scenario.hpp"
#include "incognita/io/scenario/settings.hpp"
#include "incognita/io/scenario/target_file.hpp"
#include "incognita/io/scenario/team_setting_list.hpp"
#include "incognita/messages/errors.hpp"

namespace incognita {
namespace {

struct Options {
  std::string scenario = "room";
  std::vector<std::string> sets;
  bool check = false;
  bool json = false;
};

nlohmann::json as_json(const Setting& setting) {
  const auto to_json = [](const auto* field) -> nlohmann::json {
    if constexpr (std::is_same_v<decltype(field), const Eigen::Vector3d*>) {
      return {field->x(), field->y(), field->z()};
    } else if constexpr (std::is_same_v<decltype(field), const Eigen::Vector2d*>) {
      return {field->x(), field->y()};
    } else if constexpr (std::is_same_v<decltype(field), const std::vector<Eigen::Vector2d>*>) {
      nlohmann::json list = nlohmann::json::array();
      for (const Eigen::Vector2d& point : *field) list.push_back({point.x(), point.y()});
      return list;
    } else if constexpr (std::is_enum_v<std::remove_cvref_t<decltype(*field)>>) {
      return word_of(*field);
    } else {
      return *field;
    }
  };
  return std::visit([&](const auto* field) { return to_json(field); }, setting.field);
}

const Setting& find(const std::vector<Setting>& settings, const std::string& key) {
  return *std::find_if(settings.begin(), settings.end(), [&](const Setting& s) { return s.key == key; });
}

void print_json(LoadedScenario& loaded, const std::vector<std::string>& checked) {
  Scenario defaults;
  const std::vector<Setting> settings = settings_in_force(loaded.scenario), before = list_settings(defaults);
  nlohmann::json list = nlohmann::json::array();
  for (const Setting& setting : settings) {
    list.push_back({{"key", setting.key},
                    {"value", as_json(setting)},
                    {"unit", setting.unit},
                    {"default", as_json(find(before, setting.key))},
                    {"source", loaded.sources.at(setting.key)},
                    {"allowed", setting.allowed.text()},
                    {"help", setting.help}});
  }
  const nlohmann::json document = {{"scenario", loaded.name},
                                   {"file", shown(loaded.file)},
                                   {"settings", list},
                                   {"overrides", loaded.overrides},
                                   {"checked", checked}};
  // File names may not be UTF-8; a replaced character is better than an exception.
  std::cout << document.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) << "\n";
}

void print_table(LoadedScenario& loaded) {
  Scenario defaults;
  const std::vector<Setting> settings = settings_in_force(loaded.scenario), before = list_settings(defaults);
  std::string section;
  for (const Setting& setting : settings) {
    if (section_of(setting.key) != section) {
      section = section_of(setting.key);
      std::cout << fmt::format("\n[{}]\n", section);
    }
    const std::string& source = loaded.sources.at(setting.key);
    const std::string value = setting.written() + (setting.unit.empty() ? "" : " " + setting.unit);
    std::cout << fmt::format("  {:<40} {:<28} default {:<24} from {}\n", setting.key, value,
                             find(before, setting.key).written(), source);
  }
}

std::vector<std::string> check_team(const LoadedScenario& loaded) {
  const TeamAssembly assembly = assemble_team(loaded);  // refuses what a run would refuse
  std::vector<std::string> found = assembly.notes;
  const EstimatorSettings& team = assembly.estimator;
  found.push_back(fmt::format("vehicles: {}, known landmarks: {}", team.bodies.size(), team.anchors.size()));
  return found;
}

/// Performs all checks that could stop a run before its first frame.
std::vector<std::string> check(const LoadedScenario& loaded) {
  const Scenario& s = loaded.scenario;
  std::vector<std::string> found = {"the settings are compatible"};
  if (is_team(s)) {
    for (std::string& line : check_team(loaded)) found.push_back(std::move(line));
    return found;
  }
  if (is_room_vehicle(s)) assemble_room_vehicle(loaded);  // refuses what a run would refuse
  if (s.run.sensor == "range-bearing") {
    const RangeAssembly assembly = assemble_ranges(loaded);  // refuses what a run would refuse
    const RangeRecording& recording = assembly.recording();
    found.insert(found.end(), assembly.notes.begin(), assembly.notes.end());
    found.push_back(fmt::format("{} odometry readings, {} scans, {} true places, {} surveyed landmarks",
                                recording.odometry.size(), recording.scans.size(), recording.truth.size(),
                                recording.landmarks.size()));
    return found;
  }
  if (s.start.from == StartSettings::From::target) {
    const Target target = load_target(loaded);
    found.push_back(fmt::format("target {}: {} corners, {}", target.name, target.corners.size(),
                                shown(find_target(loaded))));
  }
  if (s.run.world == "recording") {
    const auto recording = std::make_shared<const Recording>(read_recording(loaded));
    const std::string compared = compare_camera(loaded, *recording);
    const RecordedSensor first_image_fits(recording, s.camera.width_px, s.camera.height_px);
    found.insert(found.end(), recording->notes.begin(), recording->notes.end());
    if (!compared.empty()) found.push_back(compared);
    for (const Recording::RecordedFrame& frame : recording->frames) {
      if (!file_exists(frame.image))
        throw InputError(frame.image.string() + ": is listed but does not exist");
    }
    found.push_back(fmt::format("all {} images exist, the first is {}x{} px", recording->frames.size(),
                                s.camera.width_px, s.camera.height_px));
  }
  if (!is_room_vehicle(s)) assemble(loaded);  // refuses what a run would refuse
  return found;
}

int run_config(const Options& options) {
  LoadedScenario loaded = load_scenario(options.scenario, options.sets);
  for (const std::string& line : loaded.overrides) print_message("{}\n", line);
  const std::vector<std::string> checked = options.check ? check(loaded) : std::vector<std::string>{};
  if (options.json) {
    print_json(loaded, checked);
  } else if (options.check) {
    for (const std::string& line : checked) std::cout << line << "\n";
    std::cout << fmt::format("{}: valid\n", loaded.name);
  } else {
    std::cout << fmt::format("{} ({})\n", loaded.name, shown(loaded.file));
    print_table(loaded);
  }
  return 0;
}

}  // namespace

CLI::App* add_config(CLI::App& app, std::function<int()>& job) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "config", "Print every setting of a scenario with its value, unit, default and source");
  command->add_option("SCENARIO", options->scenario, "Scenario file, or the name of a built-in one")
      ->capture_default_str();
  command
      ->add_option("--set", options->sets, "Set a value before printing: section.name=value; may be repeated")
      ->allow_extra_args(false);
  command->add_flag(
      "--check", options->check,
      "Only check the settings, the target, the room or recording, and everything else that a run needs");
  command->add_flag("--json", options->json, "One JSON document on standard output");
  command->footer(
      "Example: incognita config room --set run.seed=7\n         incognita config davison --check");
  command->callback([options, &job] { job = [options] { return run_config(*options); }; });
  return command;
}

}  // namespace incognita
