#include "incognita/app/assemble_planar.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "incognita/io/files.hpp"
#include "incognita/io/range_recording.hpp"
#include "incognita/messages/errors.hpp"

namespace incognita {
namespace {

void check_vehicle(const LoadedScenario& loaded, const RangeRecording& recording) {
  const std::string& model = loaded.scenario.planar.vehicle.model;
  if (recording.vehicle == model) return;
  throw InputError(fmt::format("{}: vehicle.model = {}: the odometry of this recording is that of `{}`",
                               loaded.sources.at("vehicle.model"), model, recording.vehicle));
}

void check_identities(const LoadedScenario& loaded, const RangeRecording& recording) {
  if (loaded.scenario.planar.association.method != "known") return;
  for (const RangeRecording::Scan& scan : recording.scans)
    for (const Detection& detection : scan.detections)
      if (detection.identity != Detection::unknown) return;
  throw InputError(
      fmt::format("{}: association.method = known: no detection of this recording says which landmark it "
                  "is of; take `joint` or `nearest`",
                  loaded.sources.at("association.method")));
}

void check_fixes(const LoadedScenario& loaded, const RangeRecording& recording) {
  const PlanarSlamSettings& s = loaded.scenario.planar;
  if (!recording.fixes.empty() || !(s.start.at_first_fix || s.filter.use_fixes)) return;
  const char* key = s.filter.use_fixes ? "vehicle_filter.use_fixes" : "vehicle_start.at_first_fix";
  throw InputError(
      fmt::format("{}: {} = true: no external sensor is in this recording", loaded.sources.at(key), key));
}

}  // namespace

PlanarAssembly assemble_planar(SharedRangeRecording recording, const PlanarSlamSettings& s,
                               double duration_s) {
  const Fixes fixes = s.filter.use_fixes ? Fixes::all : s.start.at_first_fix ? Fixes::first : Fixes::none;
  return {{std::make_unique<RangeClock>(recording, duration_s),
           std::make_unique<RangeWorld>(recording),
           std::make_unique<RangeSensor>(recording, fixes, s.sensor.max_range_m),
           PlanarEstimator(s),
           {},
           {}},
          recording,
          s.filter.use_fixes || !s.filter.anchors.empty(),
          recording->notes};
}

PlanarAssembly assemble_planar(const LoadedScenario& loaded) {
  auto recording = std::make_shared<const RangeRecording>(read_range_recording(loaded));
  check_vehicle(loaded, *recording);
  check_identities(loaded, *recording);
  check_fixes(loaded, *recording);
  try {
    return assemble_planar(std::move(recording), loaded.scenario.planar, loaded.scenario.run.duration_s);
  } catch (const std::invalid_argument& error) {
    throw InputError(shown(loaded.file) + ": " + error.what());
  }
}

}  // namespace incognita
