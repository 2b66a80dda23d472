// Result of an update.
#pragma once

namespace incognita {

struct UpdateReport {
  enum class Outcome {
    updated,
    nothing,   ///< no measurements were given
    singular,  ///< not usable within rounding; the belief is unchanged
  };
  Outcome outcome = Outcome::nothing;
  double nis = 0;        ///< residual' S^-1 residual
  int rows = 0;          ///< degrees of freedom of `nis`
  double log_det_S = 0;  ///< information gain: (log_det_S - log_det_R)/2 nats, thesis (6.6)
  double log_det_R = 0;
};

}  // namespace incognita
