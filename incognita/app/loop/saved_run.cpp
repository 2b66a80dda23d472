#include "incognita/app/loop/saved_run.hpp"

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <exception>
#include <functional>
#include <map>
#include <utility>

#include "incognita/app/loop/association_score.hpp"
#include "incognita/app/loop/interventions.hpp"
#include "incognita/app/loop/observability_watch.hpp"
#include "incognita/math/saved_state/matrices.hpp"
#include "incognita/messages/errors.hpp"
#include "incognita/messages/saved_messages.hpp"
#include "incognita/slam/estimator/slam_estimator.hpp"
#include "incognita/slam/mapper/saved_estimate.hpp"

namespace incognita {
namespace {

/// Settings of a saved run that a resumed one may have otherwise.
constexpr std::array changeable_settings{"run.duration_s", "run.save_every_s"};

struct SavedScenario {
  std::string name, file, toml;
};

template <AnyStateArchive Archive>
void serialize(Archive& archive, SavedScenario& scenario) {
  auto& [name, file, toml] = scenario;
  archive(name, file, toml);
}

using SectionState = std::function<void(StateArchive&)>;

/// Throws InputError if the part cannot be saved.
StateSection saved_section(const std::string& name, const SectionState& state) {
  StateWriter writer;
  StateArchive archive(writer);
  try {
    state(archive);
  } catch (const CannotBeSaved& error) {
    throw InputError(fmt::format("the {} of this run cannot be saved: {}; docs/saved-maps.md says how", name,
                                 error.what()));
  }
  return {name, writer.take()};
}

/// Restores from the whole section.
void restore_section(const StateFile& file, const std::string& name, const SectionState& state) {
  const StateSection& section = file.section(name);
  StateReader reader(section.bytes);
  StateArchive archive(reader);
  const auto failed = [&](const std::string& why) {
    return InputError(fmt::format(
        "{}: section `{}`, byte {}: {}; the file was written by incognita {}: resume it with that version, or from another file",
        file.path.string(), name, section.offset + reader.position(), why, file.program_version));
  };
  try {
    state(archive);
  } catch (const CannotBeSaved& error) {
    throw failed(error.what());
  } catch (const InputError&) {
    throw;
  } catch (const std::exception& error) {  // also of cereal, and of a part that refuses what it gets
    throw failed(error.what());
  }
  if (reader.left() > 0) throw failed(fmt::format("{} bytes are left over", reader.left()));
}

/// Each feature of a camera is the appearance of a landmark, and each depth line is a ray of the belief.
void check_features(const Estimate& estimate, const Estimator& estimator) {
  const auto* slam = dynamic_cast<const SlamEstimator*>(&estimator);
  if (!slam) return;
  for (const FeatureTracker& camera : slam->cameras())
    for (const auto& [id, feature] : camera.camera().features)
      if (!estimate.landmarks.contains(id)) throw DamagedState(fmt::format("there is no landmark {}", id));
  for (const auto& [id, line] : slam->depth_lines().lines()) {
    const auto ray = estimate.landmarks.find(id);
    if (ray == estimate.landmarks.end() || ray->second.form.kind != LandmarkParametrization::Kind::ray)
      throw DamagedState(fmt::format("landmark {} is no ray", id));
  }
}

/// All sections but those of scenario and clock, in the order in which they are restored.
std::vector<std::pair<std::string, SectionState>> sections_of(RunState& run) {
  LoopParts& parts = run.parts;
  std::vector<std::pair<std::string, SectionState>> sections{
      {"loop",
       [&run](StateArchive& a) { a(run.loop.tick, run.loop.command, run.ever_tracked, run.ever_measured); }},
      {"estimate", [&run](StateArchive& a) { estimate_state(a, run.loop.estimate); }},
      {"estimator",
       [&run](StateArchive& a) {
         run.parts.estimator->state(a);
         if (a.restores()) check_features(run.loop.estimate, *run.parts.estimator);
       }},
      {"interventions", [&run](StateArchive& a) { run.interventions.state(a); }},
      {"strategy", [&parts](StateArchive& a) { parts.strategy->state(a); }},
      {"controller", [&parts](StateArchive& a) { parts.controller->state(a); }},
      {"world", [&parts](StateArchive& a) { parts.world->state(a); }},
      {"sensors", [&parts](StateArchive& a) { parts.sensor->state(a); }}};
  if (parts.map_truth)
    sections.emplace_back("map truth", [&parts](StateArchive& a) { parts.map_truth->state(a); });
  if (run.watch) sections.emplace_back("observability", [&run](StateArchive& a) { run.watch->state(a); });
  if (run.score) sections.emplace_back("association", [&run](StateArchive& a) { run.score->state(a); });
  return sections;
}

SavedScenario saved_scenario(const StateFile& file) {
  SavedScenario saved;
  restore_section(file, "scenario", [&](StateArchive& archive) { archive(saved); });
  return saved;
}

/// The map holds patches of the images of its camera, in a belief as the filter had it.
bool shapes_map(const std::string& key) {
  return key.starts_with("camera.") || key == "search.patch_size_px" || key == "search.levels" ||
         key == "sensor.sigma_lasting_px" || key.starts_with("estimator.") || key == "map.max_landmarks";
}

using SettingValues = std::map<std::string, std::string>;

SettingValues map_settings(const LoadedScenario& loaded) {
  SettingValues values;
  for (const SettingInForce& setting : loaded.settings)
    if (shapes_map(setting.key)) values[setting.key] = setting.value;
  return values;
}

/// Throws InputError that names the first setting that shapes the map and is another one, or only in one of the scenarios.
void refuse_other_sensors(const StateFile& file, const LoadedScenario& loaded) {
  const SettingValues before = map_settings(scenario_of(file)), now = map_settings(loaded);
  const auto value = [](const SettingValues& values, const std::string& key) {
    const auto found = values.find(key);
    return found == values.end() ? std::string("none") : found->second;
  };
  SettingValues all = before;
  all.insert(now.begin(), now.end());
  for (const auto& [key, either] : all)
    if (value(now, key) != value(before, key))
      throw InputError(fmt::format(
          "{}: {} = {}: the map of {} was made with {}: a saved map can be used with the same camera and filter only",
          loaded.source_of(key), key, value(now, key), file.path.string(), value(before, key)));
}

void refuse_change(const std::string& key, const std::string& source) {
  for (const char* const changeable : changeable_settings)
    if (key == changeable) return;
  throw InputError(fmt::format(
      "{}: `{}` cannot change in the middle of a run; only {} can. Run the scenario again without --resume",
      source, key, fmt::join(changeable_settings, " and ")));
}

}  // namespace

std::string saved_clock(Clock& clock) {
  return saved_section("clock", [&](StateArchive& archive) { clock.state(archive); }).bytes;
}

std::string saved_run(const LoadedScenario& loaded, RunState& run, const std::string& clock,
                      const std::string& program_version) {
  SavedScenario scenario{loaded.name, loaded.file.string(), effective_toml(loaded)};
  std::vector<StateSection> sections{
      saved_section("scenario", [&](StateArchive& archive) { archive(scenario); }), {"clock", clock}};
  for (const auto& [name, state] : sections_of(run)) sections.push_back(saved_section(name, state));
  return state_file_bytes(program_version, sections);
}

void restore_run(const StateFile& file, RunState& run) {
  for (const auto& [name, state] : sections_of(run)) restore_section(file, name, state);
  restore_section(file, "clock", [&](StateArchive& archive) { run.parts.clock->state(archive); });
  const std::int64_t frames = run.parts.clock->expected_frames();
  if (frames > 0 && run.loop.tick.frame + 1 >= frames)
    throw InputError(
        fmt::format("{}: this run ended at t = {:.3f} s, its last frame; extend it with --duration",
                    file.path.string(), run.loop.tick.t));
}

void restore_map(const StateFile& file, const LoadedScenario& loaded, RunState& run) {
  refuse_other_sensors(file, loaded);
  for (const auto& [name, state] : sections_of(run))
    if (name == "estimate" || name == "estimator") restore_section(file, name, state);
  auto* const estimator = dynamic_cast<SlamEstimator*>(run.parts.estimator.get());
  if (!estimator) throw InputError("--relocalize: the estimator of this run has no map of landmarks");
  try {
    estimator->forget_poses(run.loop.estimate,
                            fmt::format("the map of {} is not recognized yet", file.path.string()));
  } catch (const std::invalid_argument& error) {
    throw InputError(fmt::format("{}: --relocalize: {}", file.path.string(), error.what()));
  }
  run.ever_tracked = true;
}

LoadedScenario scenario_of(const StateFile& file, std::span<const std::string> sets,
                           std::span<const Flag> flags, std::span<const std::string> interventions) {
  for (const std::string& set : sets) refuse_change(set.substr(0, set.find('=')), "--set");
  for (const Flag& flag : flags) refuse_change(flag.key, flag.source);
  std::vector<std::string> all(sets.begin(), sets.end());
  all.insert(all.end(), interventions.begin(), interventions.end());
  const SavedScenario saved = saved_scenario(file);
  return load_scenario_text(saved.toml, file.path.string() + ", scenario", saved.name, saved.file, all,
                            flags);
}

}  // namespace incognita
