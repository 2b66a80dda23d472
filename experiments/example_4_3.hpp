// Parts of Example 4.3: the system `planar-cv`, (4.45), its states.
#pragma once

#include <vector>

#include "experiments/observability_claims.hpp"
#include "incognita/report/ledger.hpp"

namespace incognita::observability_claims::planar_cv {

inline constexpr double rounding = 1e-9;

std::vector<Claim> relative_claims();

}  // namespace incognita::observability_claims::planar_cv
