// Claims in the running text of Chapter 4: parts of the entry `text-4`.
#pragma once

#include <vector>

#include "incognita/report/ledger.hpp"

namespace incognita::observability_claims {

/// Section 4.1: Gramian, SOM and TOM, what the method can show.
std::vector<Claim> method_claims();

}  // namespace incognita::observability_claims
