// What was done to a belief, in the order it was done: for whoever works out what its filter may know, and
// what it only believes (analysis/observability/observability_monitor.hpp).
#pragma once

#include <variant>
#include <vector>

#include "incognita/belief/linearized.hpp"

namespace incognita {

/// A block was born: its error is sum of J_i * (error of parent i) + noise.
struct BlockAugmentation {
  BlockId block = 0;
  std::vector<BlockParent> parents;
  BlockMatrix noise;  ///< errors x errors
};

/// A block was told in another chart: new error = J * (old error) + noise.
struct BlockReplacement {
  BlockId block = 0;
  BlockMatrix J;
  BlockMatrix noise;
};

/// A block was forgotten.
struct BlockDrop {
  BlockId block = 0;
};

/// The covariance was changed by something else than motions and looks.
enum class CovarianceEdit {
  frame_changed,  ///< all blocks moved with one, as a map told in the frame of its vehicle does
  decorrelated,   ///< correlations were dropped
};

/// A look is one that corrected the belief: what was refused is not noted.
using BeliefEvent = std::variant<LinearizedMotion, LinearizedMeasurement, BlockAugmentation, BlockReplacement,
                                 BlockDrop, CovarianceEdit>;
using BeliefTrace = std::vector<BeliefEvent>;

}  // namespace incognita
