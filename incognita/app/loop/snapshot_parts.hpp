// Parts common to all snapshots.
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "incognita/belief/belief.hpp"
#include "incognita/messages/goal.hpp"
#include "incognita/record/snapshot/snapshot.hpp"
#include "incognita/slam/mapper/entropy_values.hpp"

namespace incognita {

using StageTimes = std::vector<std::pair<const char*, double>>;

/// The loop's stages with `estimator` replaced by its own stages, in the same order in every snapshot, zero
/// for a stage that was not executed; then `frame`: estimator, decision and control together.
StageTimes timing_of(const StageTimes& measured, std::span<const char* const> in_estimator,
                     const StageTimes& loop_ms);

SnapshotDecision snapshot_decision(const Goal& goal, const std::vector<std::string>& actions);

void put_update(Snapshot& snapshot, const UpdateReport& update, const Entropy& entropy);

}  // namespace incognita
