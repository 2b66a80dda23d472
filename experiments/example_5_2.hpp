// What Section 5.2 claims of its law, apart from the simulated vehicle.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "experiments/chapter_5_vehicle.hpp"
#include "incognita/report/ledger.hpp"

namespace incognita::section_5_2 {

inline constexpr double gain_per_s = 0.5;  ///< K = Q2 of the thesis is this times I, which it does not print

/// (5.14): 7 m, 5 deg/s, from (7, 0) on.
inline const CirclePath circle{};

/// L = Q_r^-1 Q2, below (5.13).
Eigen::Matrix2d gain(const planar::Pose<double>& pose);

/// A robot that this law steers.
closed_loop::Robot robot(const planar::Pose<double>& start, const Path& path);

/// How (5.9), (5.12), (5.13) and (5.15) are to be read.
std::vector<Claim> equation_claims();
/// Which Q2 make it converge, and when: (5.10) and below (5.13).
std::vector<Claim> convergence_claims();
/// The heading, which is not controlled: Figure 5.8 and below.
std::vector<Claim> heading_claims();

/// The range of a linear controller, head of Section 5.2.
std::vector<Claim> range_claims();

/// Our law along a path, from a start, within the limits.
using closed_loop::Way;
Way follow(const Path& path, const planar::Pose<double>& start, double duration_s);

}  // namespace incognita::section_5_2
