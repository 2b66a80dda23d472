// What Section 5.2 claims of its law, apart from the simulated vehicle.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "experiments/closed_loop_run.hpp"
#include "incognita/report/ledger.hpp"

namespace incognita::section_5_2 {

inline constexpr double gain_per_s = 0.5;  ///< K = Q2 of the thesis is this times I, which it does not print

/// (5.14): 7 m, 5 deg/s, from (7, 0) on.
inline const CirclePath circle{};

/// L = Q_r^-1 Q2, below (5.13).
Eigen::Matrix2d gain(const planar::Pose<double>& pose);

/// The vehicle whose state is known, without noise, from tick to tick.
struct Way {
  std::vector<planar::Pose<double>> poses;
  std::vector<Eigen::Vector2d> inputs;  ///< that each pose was left with
  double distance_m(const Path& path, std::size_t tick) const;
};

/// How (5.9), (5.12), (5.13) and (5.15) are to be read.
std::vector<Claim> equation_claims();
/// Which Q2 make it converge, and when: (5.10) and below (5.13).
std::vector<Claim> convergence_claims();
/// The heading, which is not controlled: Figure 5.8 and below.
std::vector<Claim> heading_claims();

/// Our law along a path, from a start, within the limits.
Way follow(const Path& path, const planar::Pose<double>& start, double duration_s);

}  // namespace incognita::section_5_2
