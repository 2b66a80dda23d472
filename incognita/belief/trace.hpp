// Record of the changes to a belief, in order. The observability analysis compares the information of the
// filter with that of the true system (analysis/observability/observability_monitor.hpp).
#pragma once

#include <variant>
#include <vector>

#include "incognita/belief/linearized.hpp"

namespace incognita {

/// A block was added: its error is sum of J_i * (error of parent i) + noise.
struct BlockAugmentation {
  BlockId block = 0;
  std::vector<BlockParent> parents;
  BlockMatrix noise;  ///< errors x errors
};

/// A block was reparametrized: new error = J * (old error) + noise.
struct BlockReplacement {
  BlockId block = 0;
  BlockMatrix J;
  BlockMatrix noise;
};

/// Errors of a vehicle were added to those of landmarks: new error = error + B * (those errors).
struct ErrorShear {
  BlockId landmark = 0;
  BlockMatrix B;  ///< errors of the landmark x those of the vehicle
};
struct BlockShear {
  BlockId vehicle = 0;
  int first = 0;  ///< of its errors, as many as B has columns
  std::vector<ErrorShear> landmarks;
};

/// A block was marginalized out.
struct BlockDrop {
  BlockId block = 0;
};

/// The covariance was changed by something other than motions and measurements.
enum class CovarianceEdit {
  frame_changed,  ///< all blocks were re-expressed in a moving frame
  decorrelated,   ///< correlations were removed
};

/// Only measurements that were applied are recorded, not rejected ones.
using BeliefEvent = std::variant<LinearizedMotion, LinearizedMeasurement, BlockAugmentation, BlockReplacement,
                                 BlockShear, BlockDrop, CovarianceEdit>;
using BeliefTrace = std::vector<BeliefEvent>;

}  // namespace incognita
