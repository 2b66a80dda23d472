// The nonlinear analysis of Hermann and Krener (IEEE TAC 1977): the codistribution of the Lie derivatives of
// the measurements, thesis (4.58)-(4.66).
//
// The fields are the drift, and one for each input that enters linearly; of inputs that do not, or that the
// kind of motion ties to the state, the whole rate at several held inputs. A derivative is worked out once
// for a landmark and holds for every one. Differentials that are combinations of others add nothing however
// often they are derived again (Isidori, Nonlinear Control Systems, 1.9), so only those that raised the rank
// go on.
#pragma once

#include "incognita/analysis/observability/lie_analysis.hpp"
#include "incognita/analysis/systems/system_motion.hpp"

namespace incognita {

/// Throws SystemTooLarge, with the measurement's place, when an expression outgrows what algebra can do in
/// seconds.
LieAnalysis analyze_lie(const SystemInstance& instance, const SystemMotion& motion, RandomStream& random,
                        const LieSettings& settings = {}, const NullSpaceSettings& rank = {});

}  // namespace incognita
