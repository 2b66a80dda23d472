// What Section 5.1 claims, by file: of linear systems, of the separation principle, of what the law is given,
// and of the simulated vehicle.
#pragma once

#include <vector>

#include "experiments/closed_loop_run.hpp"
#include "incognita/analysis/observability/linear_system.hpp"
#include "incognita/math/random.hpp"
#include "incognita/models/motion/planar_vehicle.hpp"
#include "incognita/report/experiment.hpp"

namespace incognita::section_5_1 {

/// L of (5.6), Q1 = Q2 = I, at a pose: found for heading 0, as with Q1 = I it turns with the body.
Eigen::Matrix2d gain(const planar::Pose<double>& pose);

/// Two to four states, an input or two and a measurement or two; F about the unit circle, inside and outside.
LinearSystem some_system(RandomStream& random);
Eigen::MatrixXd some_matrix(RandomStream& random, Eigen::Index rows, Eigen::Index columns);
/// Symmetric, eigenvalues from 0.1 on.
Eigen::MatrixXd some_weight(RandomStream& random, Eigen::Index size);

/// Where the example's law leads, from (-7, 0).
inline const Path to_goal = PointPath{{10, 10, 0}};
closed_loop::Setup example_setup();

std::vector<Claim> regulator_claims();
std::vector<Claim> separation_claims(const ExperimentSettings& settings);
/// What the law is given: the estimate, the truth or nothing. `free`: runs of the example, which has no known
/// landmarks.
std::vector<Claim> control_claims(const ExperimentSettings& settings,
                                  const std::vector<closed_loop::Run>& free);
/// Of the law on the vehicle whose state is known: what it costs, and when it arrives.
std::vector<Claim> vehicle_claims(int seeds);

}  // namespace incognita::section_5_1
