// Measurements predicted at the end of a hypothetical action.
#pragma once

#include <vector>

#include "incognita/belief/linearized.hpp"

namespace incognita {

/// Linearized measurement of one landmark: z = Hv * vehicle error at that time + Hl * landmark error + noise.
/// The landmark is a block of the belief, an expected one that is not mapped yet (uncorrelated with the
/// belief), or an anchor (no error).
struct PredictedMeasurement {
  enum class Of { mapped, unseen, anchor };
  Of of = Of::anchor;
  BlockId block = 0;         ///< mapped only
  int unseen = 0;            ///< index of the expected landmark; unseen only
  double unseen_var_m2 = 0;  ///< variance of each coordinate, P_uu of thesis 6.3.1; unseen only
  MeasurementJacobian Hv;    ///< rows x errors of the vehicle
  MeasurementJacobian Hl;    ///< rows x errors of the landmark; no columns for an anchor
  MeasurementMatrix R;       ///< rows x rows, positive definite

  int rows() const { return static_cast<int>(R.rows()); }
};

/// One step of a predicted path: the growth of the vehicle's error, and the measurements at its end. Error
/// after = A * error before + noise of covariance N.
struct ImaginedStep {
  BlockMatrix A, N;
  std::vector<PredictedMeasurement> measurements;
};

}  // namespace incognita
