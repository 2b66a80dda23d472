// Bundle adjustment by Levenberg-Marquardt.
#pragma once

#include "incognita/slam/bundle/bundle_equations.hpp"

namespace incognita {

struct AdjustmentSettings {
  int max_iterations = 10;
  double min_relative_decrease = 1e-4;  ///< of the cost, below which the adjustment ends
  RobustCost robust = {};
};

struct AdjustmentReport {
  enum class Outcome {
    converged,
    stopped,  ///< after max_iterations: better than before, not at the minimum
    refused,  ///< some view or point is not determined by its measurements: the bundle is as before
  };
  Outcome outcome = Outcome::refused;
  int iterations = 0;  ///< steps tried
  double first_cost = 0, last_cost = 0;
};

/// Moves views and points to the minimum of the cost. `equations` are then those of the result, linearized and factorized
/// without damping, unless refused.
AdjustmentReport adjust(Bundle& bundle, const Camera& camera, const AdjustmentSettings& settings,
                        BundleEquations& equations);

}  // namespace incognita
