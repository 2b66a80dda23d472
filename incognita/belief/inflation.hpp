// Making a covariance block diagonal without making it too small: thesis Section 3.3, (3.26)-(3.28).
//
// Dropping the correlation between two blocks is only safe when their own covariances grow: P + dP must be
// block diagonal with dP positive semi-definite. Of all such dP this takes the one that adds the least trace,
// a semidefinite programme that is solved by block-coordinate ascent on its dual (Burer-Monteiro factors;
// Wang, Chang, Kolter, "The mixing method", 2017), with a certificate: the trace that no dP can undercut.
#pragma once

#include <Eigen/Core>
#include <span>

namespace incognita {

struct InflationSettings {
  /// Of the ascent; what is then left between bound and answer is reported. Maps take 10 to 20; a thousand
  /// are needed where the best dP hardly differs from others.
  int max_sweeps = 2000;
  double tolerance = 1e-9;  ///< of the trace added, relative: stop when nearer than this to the bound
};

struct Inflation {
  Eigen::MatrixXd P;       ///< the inflated covariance
  double trace_added = 0;  ///< of P above the one given
  double least_trace = 0;  ///< no inflation that does the same adds less than this
  int sweeps = 0;
  bool converged = false;  ///< trace_added within the tolerance, or within rounding of P, of least_trace
};

/// P (n x n, symmetric positive semi-definite) made block diagonal; `sizes` of the blocks along the diagonal
/// sum to n. Two blocks have a closed form: [C C']^1/2 and [C' C]^1/2 are added. What is added always makes
/// the difference positive semi-definite, also when the ascent stopped early. Throws std::invalid_argument
/// with the sizes.
Inflation decorrelate_all(const Eigen::MatrixXd& P, std::span<const int> sizes,
                          const InflationSettings& settings = {});

/// Only the map, (3.28): the first block (the vehicle) and its correlations with all others stay as they are,
/// the others lose theirs with each other.
Inflation decorrelate_map(const Eigen::MatrixXd& P, std::span<const int> sizes,
                          const InflationSettings& settings = {});

}  // namespace incognita
