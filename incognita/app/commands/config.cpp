#include "incognita/app/commands/config.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "incognita/app/console/print_message.hpp"
#include "incognita/app/loop/assembly.hpp"
#include "incognita/app/view/settings_json.hpp"
#include "incognita/io/formats/files.hpp"
#include "incognita/io/recordings/camera_of_recording.hpp"
#include "incognita/io/recordings/recorded_images.hpp"
#include "incognita/io/recordings/recording.hpp"
#include "incognita/io/scenario/load_scenario.hpp"
#include "incognita/io/scenario/renamed_settings.hpp"
#include "incognita/io/scenario/target_file.hpp"
#include "incognita/io/scenario/unknown_setting.hpp"
#include "incognita/messages/errors.hpp"

namespace incognita {
namespace {

struct Options {
  std::string scenario = "room";
  std::vector<std::string> sets;
  bool check = false;
  bool all = false;
  bool json = false;
};

void print_json(const nlohmann::json& document) {
  // File names may not be UTF-8; a replaced character is better than an exception.
  std::cout << document.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) << "\n";
}

/// Two lines: value, default and source; the meaning.
void print_setting(const SettingInForce& s, std::string& section) {
  if (section_of(s.key) != section) {
    section = section_of(s.key);
    std::cout << fmt::format("\n[{}]\n", section);
  }
  const std::string value = s.value + (s.unit.empty() ? "" : " " + s.unit);
  std::cout << fmt::format("  {:<46} {:<28} default {:<24} from {}\n", s.key, value, s.default_value,
                           s.source)
            << "      " << s.help << (s.allowed.empty() ? "" : " (" + s.allowed + ")") << "\n";
}

std::string needs_of(const CatalogedSetting& cataloged) {
  std::vector<std::string> needs;
  for (const auto& [key, values] : cataloged.context) needs.push_back(key + " = " + values.front());
  return fmt::format("{}", fmt::join(needs, ", "));
}

/// Every setting of every scenario, with the choices that it needs.
void print_all(bool json) {
  nlohmann::json list = nlohmann::json::array();
  std::string section;
  for (const CatalogedSetting& cataloged : all_settings()) {
    if (json) {
      list.push_back(nlohmann::json::parse(setting_json(cataloged.setting)));
      list.back().erase("value");
      list.back().erase("source");
      list.back()["with"] = needs_of(cataloged);
    } else {
      SettingInForce setting = cataloged.setting;
      setting.source = cataloged.context.empty() ? "default" : needs_of(cataloged);
      print_setting(setting, section);
    }
  }
  if (!json) return;
  nlohmann::json renamed = nlohmann::json::array();
  for (const auto& [before, after] : renamed_settings())
    renamed.push_back({{"before", before}, {"after", after}});
  print_json({{"settings", list}, {"renamed", renamed}});
}

/// What the files of recorded images hold. Throws InputError for the first image that does not exist.
std::vector<std::string> check_images(const LoadedScenario& loaded) {
  const Recording recording = read_recording(loaded);
  for (const Recording::RecordedFrame& frame : recording.frames)
    if (!frame.image.empty() && !file_exists(frame.image))
      throw InputError(frame.image.string() + ": is listed but does not exist");
  const CameraSettings& camera = loaded.scenario.camera;
  return {fmt::format("all {} images exist, the first is {}x{} px", recording.frames.size(), camera.width_px,
                      camera.height_px)};
}

std::vector<std::string> check_target(const LoadedScenario& loaded) {
  const Target target = load_target(loaded);
  return {fmt::format("target {}: {} corners, {}", target.name, target.corners.size(),
                      shown(find_target(loaded)))};
}

std::string contents_of(const RangeRecording& recording) {
  return fmt::format("{} odometry readings, {} scans, {} true places, {} surveyed landmarks",
                     recording.odometry.size(), recording.scans.size(), recording.truth.size(),
                     recording.landmarks.size());
}

/// Performs all checks that could stop a run before its first frame.
std::vector<std::string> check(const LoadedScenario& loaded) {
  const Scenario& s = loaded.scenario;
  std::vector<std::string> found = {"the settings are compatible"};
  const auto add = [&](std::vector<std::string> lines) {
    for (std::string& line : lines) found.push_back(std::move(line));
  };
  const bool images = s.sensor.type == "camera" && !s.is_simulated();
  if (images && s.is_recording()) add(check_images(loaded));
  const Assembly assembly = assemble(loaded, {.is_check_only = true});  // refuses what a run would refuse
  add(assembly.notes);
  if (images && s.start.from == StartSettings::From::target) add(check_target(loaded));
  if (s.is_team())
    found.push_back(fmt::format("vehicles: {}, known landmarks: {}", assembly.info.bodies, assembly.anchors));
  else if (assembly.recordings)
    found.push_back(contents_of(assembly.recordings->front()));
  return found;
}

int run_config(const Options& options) {
  if (options.all) {
    print_all(options.json);
    return 0;
  }
  const LoadedScenario loaded = load_scenario(options.scenario, options.sets);
  for (const std::string& line : loaded.overrides) print_message("{}\n", line);
  const std::vector<std::string> checked = options.check ? check(loaded) : std::vector<std::string>{};
  if (options.json) {
    std::cout << scenario_json(loaded, checked, 2) << "\n";
  } else if (options.check) {
    for (const std::string& line : checked) std::cout << line << "\n";
    std::cout << fmt::format("{}: valid\n", loaded.name);
  } else {
    std::cout << fmt::format("{} ({})\n", loaded.name, shown(loaded.file));
    std::string section;
    for (const SettingInForce& setting : loaded.settings) print_setting(setting, section);
  }
  return 0;
}

}  // namespace

CLI::App* add_config(CLI::App& app, std::function<int()>& job) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "config", "Print every setting of a scenario with its value, unit, default, source and meaning");
  command->add_option("SCENARIO", options->scenario, "Scenario file, or the name of a built-in one")
      ->capture_default_str();
  command
      ->add_option("--set", options->sets, "Set a value before printing: section.name=value; may be repeated")
      ->allow_extra_args(false);
  command->add_flag(
      "--check", options->check,
      "Only check the settings, the target, the room or recording, and everything else that a run needs");
  command->add_flag("--all", options->all, "Every setting of every scenario, with the choices that it needs");
  command->add_flag("--json", options->json, "One JSON document on standard output");
  command->footer(
      "Example: incognita config room --set run.seed=7\n         incognita config davison --check");
  command->callback([options, &job] { job = [options] { return run_config(*options); }; });
  return command;
}

}  // namespace incognita
