// Builds the components of the loop from a scenario with a recorded range-bearing sensor.
#pragma once

#include <string>
#include <vector>

#include "incognita/app/loop/loop.hpp"
#include "incognita/io/scenario/load_scenario.hpp"
#include "incognita/record/summary/map_survey.hpp"
#include "incognita/slam/points/planar_settings.hpp"
#include "incognita/world/replay/range_replay.hpp"

namespace incognita {

struct RangeAssembly {
  LoopParts parts;
  SharedRangeRecordings recordings;  ///< a single one
  bool frame_is_fixed = true;        ///< by anchors or fixes; else the map is relative to the start pose
  std::vector<std::string> notes;    ///< assumptions and ignored data, for printing
  std::vector<std::string> warnings = {};  ///< likely problems of the recording

  const RangeRecording& recording() const { return recordings->front(); }
};

/// Throws InputError naming file and key or value.
RangeAssembly assemble_ranges(const LoadedScenario& loaded);

/// The same for a given recording, e.g. a simulated one.
RangeAssembly assemble_ranges(RangeRecording recording, const PlanarSlamSettings& settings,
                              double duration_s);

/// The surveyed landmarks of a recording. `identified`: the map uses their identities.
Survey survey_of(const RangeRecording& recording, bool identified);

}  // namespace incognita
