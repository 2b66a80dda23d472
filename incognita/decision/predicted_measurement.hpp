// A measurement as it is imagined, from where an action would lead.
#pragma once

#include <vector>

#include "incognita/belief/linearized.hpp"

namespace incognita {

/// What the sensor would tell of one landmark: noise aside, z = Hv * error of the vehicle there + Hl * error
/// of the landmark. The landmark is a block of the belief, or one that is expected and not mapped yet, which
/// nothing in the belief is correlated with, or an anchor, which has no error.
struct PredictedMeasurement {
  enum class Of { mapped, unseen, anchor };
  Of of = Of::anchor;
  BlockId block = 0;         ///< mapped only
  int unseen = 0;            ///< which of the expected ones; unseen only
  double unseen_var_m2 = 0;  ///< of each of its coordinates, P_uu of thesis 6.3.1; unseen only
  MeasurementJacobian Hv;    ///< rows x errors of the vehicle
  MeasurementJacobian Hl;    ///< rows x errors of the landmark; no columns for an anchor
  MeasurementMatrix R;       ///< rows x rows, positive definite

  int rows() const { return static_cast<int>(R.rows()); }
};

/// One step of an imagined path: how the vehicle's error grows on the way, and what would be seen at its end.
/// Error after = A * error before + noise of covariance N.
struct ImaginedStep {
  BlockMatrix A, N;
  std::vector<PredictedMeasurement> measurements;
};

}  // namespace incognita
