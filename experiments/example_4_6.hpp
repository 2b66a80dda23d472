// Parts of Example 4.6: the settings that are tried, the phases of the drive, and the ranks of the
// information.
#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "experiments/example_4_6_filter.hpp"
#include "experiments/two_findings.hpp"
#include "incognita/report/ledger.hpp"

namespace incognita::two_bearings {

inline constexpr double a_bit_s = 1e-6;

/// All settings that are tried, the usual one not least; made once.
const std::vector<Run>& runs();
const Run& usual();
/// The same drives as the method of the thesis has them: in place of the information the matrix (4.8), each step
/// a segment. Its rank and what is in its null space are meant; marginal information of it is but zero or not.
const std::vector<Run>& runs_by_method();

inline constexpr int phases = 3;  ///< at rest, to the north, turning
int phase_of(double t_s);

using Ranks = std::array<int, phases>;

struct RankCourse {
  Ranks at_end = {};       ///< of each phase
  bool throughout = true;  ///< the same from each phase's first measurement on, and unambiguous
  double least_kept = 1;   ///< singular values, of the largest
  double most_left_out = 1e-300;
  bool is(const Ranks& expected) const { return at_end == expected && throughout; }
};
RankCourse ranks_of(const Run& run);
RankCourse ranks_of_all(const std::vector<Run>& all = runs());
std::string text(const Ranks& ranks);
std::string text(const RankCourse& course);

/// The claim by assessed(), which rests on all settings. What is observable of the system has two findings
/// (observability_claims.hpp): InTruth by runs(), ByMethod by runs_by_method().
template <class... Findings>
Claim tested(std::string id, std::string place, std::string statement, Evidence evidence,
             const Findings&... findings) {
  evidence.runs = runs().size();
  return assessed(std::move(id), std::move(place), std::move(statement), std::move(evidence), findings...);
}

/// Largest information over all of the runs and measurements up to a time.
double most(const Direction& c, double until_s = end_s, const std::vector<Run>& all = runs());

/// Figure 4.4: the ranks at rest, to the north, turning; and Section 4.3, to which matrix they belong.
std::vector<Claim> rank_claims();
Claim link();

}  // namespace incognita::two_bearings
