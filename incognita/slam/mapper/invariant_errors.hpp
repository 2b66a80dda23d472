// Errors that turn with the world: the right-invariant filter (Barrau, Bonnabel, arXiv:1510.06263, 2015), for one body that
// moves freely in space.
//
// Images do not show a turn of the whole world, bodies and landmarks together. Its direction in the state depends on the state:
// a turn by t moves a landmark at l by t x l. A filter whose means move while its covariance remembers where they were takes
// the difference for information about the turn, and becomes overconfident. Here the errors that the covariance describes move
// with the means: when the mean of a landmark moved, its error becomes error + (G_now - G_before) t, where G is the derivative
// of the landmark by a turn of the world, and t the rotation error of the body in world axes. Those of the body do the same.
// That is the covariance of the right-invariant filter, in the coordinates of the others.
#pragma once

#include "incognita/slam/mapper/estimate.hpp"

namespace incognita {

/// After a correction that moved the means of the estimate, that of the body from `before` (a free camera's state). Quadratic in
/// the map.
void keep_errors_invariant(Estimate& estimate, BlockId body, const SmallVector& before);

/// New landmarks have errors at their means. Call it once they were added.
void begin_invariant_errors(Estimate& estimate);

/// All landmarks have, as after a body was put elsewhere.
void restart_invariant_errors(Estimate& estimate);

}  // namespace incognita
