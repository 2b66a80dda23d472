// The observability matrices of thesis Chapter 4: of piecewise constant segments, stripped and total, and
// along the motion itself.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "incognita/analysis/observability/null_space.hpp"
#include "incognita/analysis/systems/system_motion.hpp"

namespace incognita {

/// [H; H F; ...; H F^(n-1)], less rows that are nothing but rounding: (4.6).
NoisyRows segment_observability(const Linearization& segment);

std::vector<NoisyRows> segment_observability(const std::vector<Linearization>& segments);

/// Q_1 to Q_k below each other, (4.8), for each k; each as at most n rows.
std::vector<NoisyRows> stripped_observability(const std::vector<NoisyRows>& Q);

/// The same, each Q_j brought to the start by the exponentials of the segments before: (4.7).
std::vector<NoisyRows> total_observability(const std::vector<NoisyRows>& Q,
                                           const std::vector<Linearization>& segments,
                                           const std::vector<double>& durations_s);

/// Whether what segment `of` does not see stays where it is: N(Q_j) within N(F_j), (4.9).
bool null_space_stays(const Linearization& segment, const NullSpace& of_segment);

/// H(t_i) Phi(t_i, 0) below each other, exact derivatives along the motion (Huang, Mourikis, Roumeliotis,
/// IJRR 2010); what unknown disturbances could have caused as well is taken out. `whitened`: each row is
/// divided by its measurement's sigma, so that M' M is the Fisher information about the states at the start;
/// else by the largest entry of its row of H in the units of the states.
NoisyRows local_observability(const SystemInstance& instance, const std::vector<MotionSample>& samples,
                              bool whitened);

}  // namespace incognita
