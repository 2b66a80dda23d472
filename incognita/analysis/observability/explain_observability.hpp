// Explanations of observability results: names of unobservable directions, and why methods disagree.
#pragma once

#include <string>
#include <vector>

#include "incognita/analysis/observability/observability.hpp"
#include "incognita/analysis/systems/system_motion.hpp"

namespace incognita {

/// Basis of the space: first those of `named` that lie in it, then combinations of them, then single states,
/// then the remainder as combinations of states.
std::vector<UnobservableDirection> named_directions(const NullSpace& space,
                                                    const std::vector<NamedDirection>& named,
                                                    const std::vector<std::string>& states);

ObservableSpace observable_space(const NoisyRows& rows, const std::vector<NamedDirection>& named,
                                 const std::vector<std::string>& states, const NullSpaceSettings& settings);

std::vector<std::string> disagreements_in(const ObservabilityAnalysis& analysis,
                                          const SystemInstance& instance, const SystemMotion& motion,
                                          const std::vector<MotionSample>& samples,
                                          const NullSpaceSettings& rank);

/// Limit of the growth of small differences along the motion; beyond it, rounding dominates.
constexpr double most_growth = 1e8;

std::vector<std::string> doubts_in(const ObservabilityAnalysis& analysis);

std::vector<std::string> notes_on(const ObservabilityAnalysis& analysis, const SymbolicSystem& system);

}  // namespace incognita
