// Strategies of Sections 6.3 and 6.4, and the claims about them that are made of points and of images alike.
//
// Every comparison is paired by room and noise, and counts all rooms: a run that diverged or was lost counts
// with its last entropy, although that is overconfident, and with its error. What a lower entropy is worth
// is therefore judged beside it by the position errors of the same runs.
#pragma once

#include <string>
#include <vector>

#include "experiments/evidence.hpp"
#include "experiments/exploring_comparison.hpp"

namespace incognita::exploring {

/// What claims of one set-up have in common.
struct Common {
  std::string id;  ///< begins the ids
  std::string place;
  std::string world;  ///< ends the statements with the set-up: "in rooms of 33 points (...)"
};

/// Translation by mutual information, gaze by (i), (ii), (iii) of the thesis, in their order.
const std::vector<Strategy>& by_gaze();
/// At random, along a fixed sequence of moves, standing; they turn as (i) does.
const std::vector<Strategy>& baselines();
/// Of a vehicle that carries the camera: mutual information, at random, to and fro, standing.
const std::vector<Strategy>& driving();

/// The claims that `ours` leaves less entropy than each of the rivals (`ID-entropy`), and that it has the
/// smaller position error (`ID-errors`). Either holds on the condition that it is less than some of them
/// if it is shown for these and refuted for others; the condition names all. `who` begins the statements.
std::vector<Claim> against(const Common& common, const std::string& who, const Runs& ours,
                           const std::vector<Runs>& rivals);

/// Runs `by_gaze`: errors, pace of initialization, entropies at the 14th landmark, closing of loops.
std::vector<Claim> gaze_claims(const Common& common, const std::vector<Runs>& runs);

/// Position errors inside 2 sigma: Figures 6.5 and 6.10.
Claim inside_its_bounds(const Common& common, const std::string& place, const Runs& runs);

/// That moves are across the line of sight more often than by chance.
Claim moves_across(const Common& common, const Runs& runs);

/// That a vehicle drives more than half of its path backward; and that its most frequent decisions are to
/// drive faster and slower.
Claim backs_away(const Common& common, const Runs& runs);
Claim accelerates(const Common& common, const Runs& runs);

/// Of the runs of our metric beside those that count all, as printed, and those of the baselines: `against` each,
/// with ids ID-as-mapped-.
std::vector<Claim> counted_as_mapped(const Common& common, const Runs& ours, std::vector<Runs> blind,
                                     const Runs& all);

/// The claims with those numbers after what the first has measured.
std::vector<Claim> with_numbers(std::vector<Claim> claims, const std::string& numbers);

}  // namespace incognita::exploring
