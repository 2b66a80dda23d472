// Whether estimation affects control: the same law given the estimate and the truth, the same noises for both.
#pragma once

#include <string>

#include "experiments/closed_loop_statistics.hpp"

namespace incognita::closed_loop {

/// Runs of an example with two known landmarks, as full observability takes; and steered by the truth.
struct ControlRuns {
  Runs known, known_by_truth, free_by_truth;
};
ControlRuns control_runs(const ExperimentSettings& settings, const std::string& example, const Setup& setup);

struct ControlClaim {
  std::string id, place, statement;
  Span span;  ///< of the runs, over which distances from the reference are root mean squares
};

/// The claim that the law of the example does as well by the estimate as by the truth. `free`: runs of the example
/// itself, which has no known landmarks.
Claim affected_by_estimation(const ControlClaim& claim, const Setup& setup, const ControlRuns& runs,
                             const Runs& free);

}  // namespace incognita::closed_loop
