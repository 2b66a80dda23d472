// The correction of the belief by all matches of a tick at once.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "incognita/slam/mapper/estimate.hpp"
#include "incognita/slam/mapper/settings.hpp"

namespace incognita {

/// The measurements in the same order, linearized at the belief's current means; without parts where one is not defined.
using Relinearize = std::function<std::vector<LinearizedMeasurement>(const AnyBelief&)>;

/// Corrects the belief as the settings ask: in one step, or iterated with `relinearize`. Fills the report of the update
/// and the record of recent innovations; false without measurements and when the update was refused.
bool correct(Estimate& estimate, std::span<const LinearizedMeasurement> measurements,
             const Relinearize& relinearize, const EstimatorSettings& settings);

}  // namespace incognita
