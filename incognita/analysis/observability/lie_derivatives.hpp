// Nonlinear observability after Hermann and Krener (IEEE TAC 1977): the codistribution of the Lie derivatives
// of the measurements, thesis (4.58)-(4.66).
//
// The fields are the drift and one per input that enters linearly; for inputs that do not, or that the kind
// of motion ties to the state, the full rate at several held inputs. A derivative is computed once for a
// landmark and holds for all. Differentials that are combinations of others add nothing under further
// differentiation (Isidori, Nonlinear Control Systems, 1.9), so only those that increased the rank are
// differentiated further.
#pragma once

#include "incognita/analysis/observability/lie_analysis.hpp"
#include "incognita/analysis/systems/system_motion.hpp"

namespace incognita {

/// Throws SystemTooLarge, with the location of the measurement, if an expression exceeds what computer
/// algebra can handle in seconds.
LieAnalysis analyze_lie(const SystemInstance& instance, const SystemMotion& motion, RandomStream& random,
                        const LieSettings& settings = {}, const NullSpaceSettings& rank = {});

}  // namespace incognita
