#include "incognita/app/loop/assembly.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

#include "incognita/app/loop/assemblers.hpp"
#include "incognita/app/loop/body_models.hpp"
#include "incognita/app/loop/world_outline.hpp"
#include "incognita/io/scenario/enum_words.hpp"
#include "incognita/io/scenario/located.hpp"
#include "incognita/messages/errors.hpp"
#include "incognita/messages/unfit_setting.hpp"

namespace incognita {
namespace {

Assembly assembled(const LoadedScenario& loaded, const LiveSources& sources) {
  const Scenario& s = loaded.scenario;
  if (s.is_simulated()) return assemble_points(loaded);
  if (s.is_live()) return assemble_live_camera(loaded, sources);
  if (s.is_robot()) return assemble_robot(loaded);
  if (!s.is_recording()) return assemble_rendered(loaded);
  return s.sensor.type == "camera" ? assemble_recorded_images(loaded) : assemble_recorded_ranges(loaded);
}

/// A gaze that is given and not used; empty if there is none.
std::string note_of_gaze(const LoadedScenario& loaded) {
  const DecisionSettings& d = loaded.scenario.decision;
  const std::string source = loaded.source_of("decision.gaze");
  const bool plans = d.strategy == DecisionSettings::Strategy::plan;
  const bool given = plans ? source.starts_with("--")
                           : source != "default";  // files name the gaze of the other strategies too
  if (!(plans || d.strategy == DecisionSettings::Strategy::frontier) || !given) return {};
  return fmt::format("decision.gaze = `{}` (from {}) is not used: the strategy `{}` turns the gaze itself",
                     word_of(d.gaze), source, plans ? "plan" : "frontier");
}

}  // namespace

void put_scenario(const LoadedScenario& loaded, RunInfo& info) {
  const Scenario& s = loaded.scenario;
  info.name = loaded.name;
  info.effective_toml = effective_toml(loaded);
  info.seed = s.run.seed;
  info.patch_size_px = s.slam.search.patch_size_px;
  if (!s.is_recording()) info.rate_hz = s.run.rate_hz;
  const bool has_camera = s.is_simulated() ? dimensions_of(sensor_of(s)) == 3 : s.sensor.type == "camera";
  if (has_camera) info.camera = intrinsics_of(s.camera);
}

Assembly assemble(const LoadedScenario& loaded, const LiveSources& sources) {
  try {
    Assembly out = assembled(loaded, sources);
    if (std::string note = note_of_gaze(loaded); !note.empty()) out.notes.push_back(std::move(note));
    return out;
  } catch (const UnfitSetting& unfit) {  // e.g. a room too small for its boxes
    throw InputError(located(loaded, unfit));
  } catch (const std::invalid_argument& error) {
    throw InputError(located(loaded, std::string(error.what())));
  }
}

}  // namespace incognita
