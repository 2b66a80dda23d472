// Claims that the running text makes outside the examples: parts of the entry `text-1-3`.
#pragma once

#include <vector>

#include "incognita/report/ledger.hpp"

namespace incognita {

/// The abstract, as far as the linear case decides it.
std::vector<Claim> abstract_claims(int seeds);

/// Chapter 2: properties of SLAM, the Riccati equation (2.18), new landmarks (2.20)-(2.26); Appendix A.
std::vector<Claim> chapter_2_claims(int seeds);

/// Chapter 3 outside its examples, and Chapter 1 about it.
std::vector<Claim> chapter_3_stability_claims();
std::vector<Claim> chapter_3_landmark_claims(int seeds);

}  // namespace incognita
