// Builds snapshots from the messages of the loop.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "incognita/decision/strategy.hpp"
#include "incognita/messages/command.hpp"
#include "incognita/messages/goal.hpp"
#include "incognita/messages/observation.hpp"
#include "incognita/record/snapshot/snapshot.hpp"
#include "incognita/slam/mapper/estimate.hpp"
#include "incognita/world/truth.hpp"

namespace incognita {

using StageTimes = std::vector<std::pair<const char*, double>>;

/// Each body as a rigid body in space; of each measurement the first two components. `loop_ms`: times of the loop's
/// stages; that of the estimator is replaced by its own measured stages, the same in every snapshot, zero for a stage
/// that was not executed. The stage `frame` is the computation that a real robot needs: estimator, decision and
/// control, without simulation and recording.
Snapshot snapshot_of(const Tick& tick, const std::optional<Truth>& truth, const Observation& observation,
                     const Estimate& estimate, const Goal& goal, const Strategy& strategy,
                     const Command& command, const StageTimes& loop_ms);

}  // namespace incognita
