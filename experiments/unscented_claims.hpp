// Claims about the unscented transformation of the vehicle states, the third contribution of the thesis.
#pragma once

#include <vector>

#include "incognita/report/ledger.hpp"

namespace incognita {

/// On simulated drives, and what a prediction costs; on the recording see car_park_full_covariance.cpp.
std::vector<Claim> unscented_claims(int seeds);

}  // namespace incognita
