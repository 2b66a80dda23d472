// Builds the parts of the loop from a scenario of any kind.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "incognita/app/loop/loop.hpp"
#include "incognita/io/scenario/load_scenario.hpp"
#include "incognita/record/summary/run_summary.hpp"
#include "incognita/slam/points/planar_settings.hpp"
#include "incognita/world/live/live_feed.hpp"
#include "incognita/world/live/robot_link.hpp"
#include "incognita/world/points/point_world.hpp"
#include "incognita/world/replay/recorded_ranges.hpp"

namespace incognita {

struct Assembly {
  LoopParts parts;
  RunInfo info;                         ///< what is known of the run before it starts
  std::vector<std::string> notes = {};  ///< assumptions and ignored data, for printing
  int anchors = 0;                      ///< landmarks at known positions
  /// True identity of each detection, tick by tick, for evaluation; null if the estimator gets the identities.
  std::shared_ptr<const AssociationTruth> association_truth = nullptr;
  SharedRangeRecordings recordings = nullptr;  ///< of range-bearing sensors; null otherwise
  std::shared_ptr<LiveFeed> live = nullptr;    ///< clock and sensors of a camera or robot; null otherwise
  std::shared_ptr<RobotLink> robot = nullptr;  ///< null without one
};

/// Cameras that the program has besides those that a scenario names.
struct LiveSources {
  std::shared_ptr<LiveSource> browser = nullptr;  ///< of the page
  bool is_check_only = false;                     ///< nothing runs: no camera is opened
};

/// Throws InputError naming file and key or value, e.g. for a sensor that does not fit the vehicle, or a control law or
/// path that the vehicle cannot follow.
Assembly assemble(const LoadedScenario& loaded, const LiveSources& sources = {});

/// For a recording of a vehicle with a range-bearing sensor that is given, e.g. simulated.
Assembly assemble_ranges(RangeRecording recording, const PlanarSlamSettings& settings, double duration_s);

}  // namespace incognita
