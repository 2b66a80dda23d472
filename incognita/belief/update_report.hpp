// What became of an update.
#pragma once

namespace incognita {

struct UpdateReport {
  enum class Outcome {
    updated,
    nothing,   ///< no looks were given
    singular,  ///< the looks cannot be used within rounding; the belief is unchanged
  };
  Outcome outcome = Outcome::nothing;
  double nis = 0;        ///< residual' S^-1 residual
  int rows = 0;          ///< its degrees of freedom
  double log_det_S = 0;  ///< so the update took (log_det_S - log_det_R)/2 nats of entropy: thesis (6.6)
  double log_det_R = 0;
};

}  // namespace incognita
