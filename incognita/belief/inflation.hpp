// Conservative block-diagonal covariances: thesis Section 3.3, (3.26)-(3.28).
//
// Removing the correlation between two blocks is conservative only if their own covariances grow: P + dP must
// be block diagonal with dP positive semidefinite. The dP of least trace solves a semidefinite program, here
// by block-coordinate ascent on its dual (Burer-Monteiro factors; Wang, Chang, Kolter, "The mixing method",
// 2017). The dual value certifies it: no dP has less trace.
#pragma once

#include <Eigen/Core>
#include <span>

namespace incognita {

struct InflationSettings {
  /// Limit on the sweeps of the ascent; the remaining duality gap is reported. Maps typically take 10 to 20;
  /// nearly degenerate problems take a thousand.
  int max_sweeps = 2000;
  double tolerance = 1e-9;  ///< stop when the duality gap is below this fraction of the bound
};

struct Inflation {
  Eigen::MatrixXd P;       ///< the inflated covariance
  double trace_added = 0;  ///< trace of the inflated P minus that of the given one
  double least_trace = 0;  ///< lower bound on the trace any such inflation adds
  int sweeps = 0;
  bool converged = false;  ///< duality gap within the tolerance or within rounding of P
};

/// Block-diagonal bound of P (n x n, symmetric positive semidefinite); the `sizes` of the diagonal blocks sum
/// to n. Two blocks have a closed form: [C C']^1/2 and [C' C]^1/2 are added. The difference is positive
/// semidefinite even when the ascent stops early. Throws std::invalid_argument, with the sizes, when they do
/// not fit, and when P is not finite.
Inflation decorrelate_all(const Eigen::MatrixXd& P, std::span<const int> sizes,
                          const InflationSettings& settings = {});

/// The same for the map only, (3.28): the first block (the vehicle) and its correlations with all others are
/// kept, the correlations among the others are removed.
Inflation decorrelate_map(const Eigen::MatrixXd& P, std::span<const int> sizes,
                          const InflationSettings& settings = {});

}  // namespace incognita
