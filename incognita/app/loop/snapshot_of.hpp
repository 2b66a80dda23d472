// Builds snapshots from the messages of the loop.
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

/// `loop_ms`: times of the loop's stages; that of the estimator is replaced by its own measured stages. The
/// stage `frame` is the computation that a real robot needs: estimator, decision and control, without
/// simulation and recording.
Snapshot snapshot_of(const Tick& tick, const std::optional<Truth>& truth, const Observation& observation,
                     const Estimate& estimate, const Goal& goal, const std::vector<std::string>& actions,
                     const Command& command, const std::vector<std::pair<const char*, double>>& loop_ms);

/// Snapshot of a team, each vehicle as a rigid body in space. Of each measurement, the first two components.
Snapshot snapshot_of(const Tick& tick, const std::optional<Truth>& truth, const Observation& observation,
                     const TeamEstimate& estimate, const Goal& goal, const std::vector<std::string>& actions,
                     const Command& command, const std::vector<std::pair<const char*, double>>& loop_ms);

}  // namespace incognita
