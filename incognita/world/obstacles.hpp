// Obstacles of a simulated body.
#pragma once

#include "incognita/math/small_matrix.hpp"

namespace incognita {

class Obstacles {
 public:
  virtual ~Obstacles() = default;
  /// Throws std::invalid_argument if the body cannot start there.
  virtual void check_start(const SmallVector& state) const = 0;
  /// Stops a body that moved from `before` to `state`, both states of its motion model. Returns whether it was stopped.
  virtual bool stop(const SmallVector& before, SmallVector& state) const = 0;
};

}  // namespace incognita
