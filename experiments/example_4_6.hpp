// Parts of Example 4.6: the settings that are tried, the phases of the drive, and the ranks of the
// information.
#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "experiments/evidence.hpp"
#include "experiments/example_4_6_filter.hpp"
#include "incognita/report/ledger.hpp"

namespace incognita::two_bearings {

inline constexpr double a_bit_s = 1e-6;

/// All settings that are tried, the usual one not least; made once.
const std::vector<Run>& runs();
const Run& usual();

inline constexpr int phases = 3;  ///< at rest, to the north, turning
int phase_of(double t_s);

using Ranks = std::array<int, phases>;

struct RankCourse {
  Ranks at_end = {};       ///< of each phase
  bool throughout = true;  ///< the same from each phase's first measurement on
  bool clear = true;       ///< at all measurements
  double least_kept = 1;   ///< singular values, of the largest
  double most_left_out = 1e-300;
  bool is(const Ranks& expected) const { return at_end == expected && throughout && clear; }
  void take(const RankCourse& other) {
    throughout = throughout && other.throughout && at_end == other.at_end;
    clear = clear && other.clear;
    least_kept = std::min(least_kept, other.least_kept);
    most_left_out = std::max(most_left_out, other.most_left_out);
  }
};
RankCourse ranks_of(const Run& run);
RankCourse ranks_of_all();
std::string text(const Ranks& ranks);
std::string text(const RankCourse& course);

/// The claim, which rests on all settings.
Claim tested(std::string id, std::string place, std::string statement, Evidence evidence, Finding printed,
             Finding corrected = Finding::refuted);

/// Largest information over all settings and measurements up to a time.
double most(const Direction& c, double until_s = end_s);

/// Figure 4.4: the ranks at rest, to the north, turning; and Section 4.3, to which matrix they belong.
std::vector<Claim> rank_claims();
Claim link();

}  // namespace incognita::two_bearings
