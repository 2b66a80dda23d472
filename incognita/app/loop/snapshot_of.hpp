// From the loop's messages to what files and screens may see.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "incognita/messages/goal.hpp"
#include "incognita/messages/observation.hpp"
#include "incognita/record/snapshot/snapshot.hpp"
#include "incognita/slam/features/estimate.hpp"
#include "incognita/slam/points/team_estimate.hpp"

namespace incognita {

/// `loop_ms`: the loop's own stages; the estimator's are taken apart into what it measured itself. The stage
/// `frame` is everything a robot would have to do: estimator, advice and control, not the simulated world nor
/// the files.
Snapshot snapshot_of(const Tick& tick, const std::optional<Truth>& truth, const Observation& observation,
                     const Estimate& estimate, const Goal& goal, const std::vector<std::string>& actions,
                     const Command& command, const std::vector<std::pair<const char*, double>>& loop_ms);

/// Vehicles of a team, each as a body in space. Looks are numbers of the sensor's, the first two of each.
Snapshot snapshot_of(const Tick& tick, const std::optional<Truth>& truth, const Observation& observation,
                     const TeamEstimate& estimate, const Goal& goal, const std::vector<std::string>& actions,
                     const Command& command, const std::vector<std::pair<const char*, double>>& loop_ms);

}  // namespace incognita
