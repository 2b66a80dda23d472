// Claims of Chapter 4 that are parts of an entry, in files of their own.
#pragma once

#include <vector>

#include "experiments/observability_claims.hpp"
#include "incognita/report/ledger.hpp"

namespace incognita::observability_claims {

/// Section 4.1: Gramian, SOM and TOM, what the method can show.
std::vector<Claim> method_claims();

/// Example 4.3: the relative map.
std::vector<Claim> planar_cv_relative_claims();

}  // namespace incognita::observability_claims
