// What Appendix C claims of the implementation, by file.
#pragma once

#include <vector>

#include "experiments/evidence.hpp"

namespace incognita::appendix_c {

/// C.2: patches from another viewpoint, and searches within 3 sigma; of `rooms` rooms.
std::vector<Claim> view_claims(int rooms);
/// C.2: searches with large S.
std::vector<Claim> search_claims();
/// C.1: what an update costs.
std::vector<Claim> cost_claims();
/// C.4: mismatches; of `rooms` rooms of points.
std::vector<Claim> mismatch_claims(int rooms);
/// C.4: clutter; of `rooms` rooms on images.
std::vector<Claim> clutter_claims(int rooms);

}  // namespace incognita::appendix_c
