// From a scenario whose sensor measures ranges and bearings to the boxes of the loop.
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
  TeamBoxes boxes;
  SharedRangeRecordings recordings;  ///< one
  bool frame_is_fixed = true;  ///< by anchors or fixes; else the map is relative to the start of the vehicle
  std::vector<std::string> notes;          ///< what was guessed or left out, for printing
  std::vector<std::string> warnings = {};  ///< what is most likely wrong with the recording

  const RangeRecording& recording() const { return recordings->front(); }
};

/// Throws InputError naming file and key or value.
RangeAssembly assemble_ranges(const LoadedScenario& loaded);

/// The same on a recording that is at hand, e.g. simulated.
RangeAssembly assemble_ranges(RangeRecording recording, const PlanarSlamSettings& settings,
                              double duration_s);

/// The surveyed landmarks of a recording. `identified`: the map has their identities.
Survey survey_of(const RangeRecording& recording, bool identified);

}  // namespace incognita
