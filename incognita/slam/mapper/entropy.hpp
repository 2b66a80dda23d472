// Entropies of an estimate: thesis (6.2).
#pragma once

#include <optional>

#include "incognita/belief/aligned_buffer.hpp"
#include "incognita/belief/tiled_cholesky.hpp"
#include "incognita/slam/mapper/estimate.hpp"

namespace incognita {

class StateArchive;

/// Entropy of the bodies, nats; NaN when their covariance is not positive definite.
double vehicle_entropy(const Estimate& estimate);

/// Entropies of the bodies, the map and both, nats: at once. Cubic in the map, linear with a block-diagonal map. NaN when
/// the covariance is not positive definite. For a map in the vehicle frame the pose is that of the world in it.
Entropy entropies(const Estimate& estimate);

/// The entropies of a running estimate. Those of map and total need a Cholesky factor of the covariance, which is cubic in
/// the state. Of a small state they are computed at once. Of a larger one the covariance is copied, which is quadratic like
/// an update, and factorized over the following ticks, each with a bounded share of the work; the result then stands
/// for the time of the copy, `Estimate::entropy_t`. What is done at a tick does not depend on the clock of the computer.
class RunningEntropy {
 public:
  /// Largest state whose entropies are computed at once, errors: about 1 ms.
  static constexpr int max_errors_at_once = 384;

  /// Refreshes the entropies of the estimate at time `t`, s: that of the bodies at each tick, the others when they are due,
  /// once a second, or done. Allocates for the largest state so far only.
  void update(Estimate& estimate, double t);

  /// Steps of TiledCholesky per tick: as many floating-point operations as an update with one row, and no fewer than 4e6.
  static long steps_per_tick(int errors);

  /// Saves or restores: math/saved_state/.
  void state(StateArchive& archive);

 private:
  void start(const Estimate& estimate, double t);
  void advance(Estimate& estimate);

  AlignedBuffer ordered_, workspace_;
  TiledCholesky cholesky_;                 ///< of the copy
  int map_errors_ = 0, total_errors_ = 0;  ///< of the copy
  std::optional<double> copy_t_;           ///< s, time of the copy that is being factorized
  std::optional<double> last_start_t_;     ///< s, of the last refresh: begun or at once
};

}  // namespace incognita
