// Strategies of a camera for translation and gaze, and the claims of Section 6.3 about them, for points and
// for images.
#pragma once

#include <string>
#include <vector>

#include "experiments/exploring_comparison.hpp"

namespace incognita::exploring {

/// What claims of Sections 6.3 and 6.4 have in common: ids begin with `id`, `variant` ends each statement
/// where the set-up is not the thesis', and `why` is the diagnosis of those that do not hold.
struct Common {
  std::string id, place, variant = {}, why = {};
};

/// exploration.counted = "as-mapped": ours, beside the printed metric that counts all.
inline const std::string as_mapped =
    ". Variant: unseen landmarks count only as far as they would be mapped (exploration.counted = as-mapped)";

/// Translation by mutual information, gaze by (i), (ii), (iii) of the thesis, in their order.
const std::vector<Strategy>& by_gaze();
/// At random, along a fixed sequence of moves, standing; they turn as (i) does.
const std::vector<Strategy>& baselines();

/// The claims that `active` leaves less entropy than each of the baselines, whose runs are `runs`. Ids end in
/// `-random`, `-fixed` and `-standing`; `what` begins the statement, e.g. "Moving by mutual information".
std::vector<Claim> against_baselines(const Common& common, const std::string& what, const Runs& active,
                                     const std::vector<Runs>& runs);

/// Of a vehicle that carries the camera: mutual information, at random, to and fro, standing.
const std::vector<Strategy>& driving();

/// The claims that `active` leaves less entropy than driving at random, to and fro, and standing: those of
/// `runs`, which are in the order of driving().
std::vector<Claim> driving_claims(const Common& common, const Runs& active, const std::vector<Runs>& runs);

/// Runs `by_gaze`: entropies at the 14th landmark, and how fast landmarks are located.
std::vector<Claim> gaze_claims(const Common& common, const std::vector<Runs>& runs);

/// That moves are across the line of sight more often than by chance; `whose`: which runs these are.
Claim moves_across(const Common& common, const Runs& runs, const std::string& whose);

/// The claims, with those numbers after what the first has measured.
std::vector<Claim> with_numbers(std::vector<Claim> claims, const std::string& numbers);

/// Numbers of several strategies, one after the other.
std::string in_numbers(const std::vector<Strategy>& strategies, const std::vector<Runs>& runs);

}  // namespace incognita::exploring
