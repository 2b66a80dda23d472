// Observability matrices of thesis Chapter 4: for piecewise constant segments, stripped and total, and along
// the motion.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "incognita/analysis/observability/null_space.hpp"
#include "incognita/analysis/systems/system_motion.hpp"

namespace incognita {

/// [H; H F; ...; H F^(n-1)], without rows at rounding level: (4.6).
NoisyRows segment_observability(const LinearizedSystem& segment);

std::vector<NoisyRows> segment_observability(const std::vector<LinearizedSystem>& segments);

/// Q_1 to Q_k stacked, (4.8), for each k; each condensed to at most n rows.
std::vector<NoisyRows> stripped_observability(const std::vector<NoisyRows>& Q);

/// The same, with each Q_j transformed to the start by the exponentials of the previous segments: (4.7).
std::vector<NoisyRows> total_observability(const std::vector<NoisyRows>& Q,
                                           const std::vector<LinearizedSystem>& segments,
                                           const std::vector<double>& durations_s);

/// Whether the unobservable subspace of the segment is invariant: N(Q_j) within N(F_j), (4.9).
bool null_space_stays(const LinearizedSystem& segment, const NullSpace& of_segment);

/// H(t_i) Phi(t_i, 0) stacked, with exact derivatives along the motion (Huang, Mourikis, Roumeliotis, IJRR
/// 2010); the effect of unknown disturbances is projected out. `whitened`: each row is divided by its
/// measurement's sigma, so that M' M is the Fisher information of the initial states; otherwise by the
/// largest entry of its row of H in the units of the states.
NoisyRows local_observability(const SystemInstance& instance, const std::vector<MotionSample>& samples,
                              bool whitened);

}  // namespace incognita
