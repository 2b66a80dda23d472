// The uncertainty of a body relative to what it matched last. Without a target, anchors or fixes its position in the world is
// unobservable, and so is the scale of a map from images: the sigma of that position grows without limit in a filter that is
// consistent and matches everything. What decides whether measurements can be associated is the sigma relative to
// the landmarks around, over their distance.
#pragma once

#include <optional>
#include <vector>

#include "incognita/slam/mapper/estimate.hpp"
#include "incognita/slam/mapper/settings.hpp"

namespace incognita {

struct RelativeSigma {
  double sigma_m =
      0;  ///< of the position of the body relative to a landmark, along the direction of largest uncertainty
  double distance_m = 0;  ///< of that landmark when it was matched
  double ratio() const { return sigma_m / distance_m; }
};

/// Remembers the landmarks and bodies that each body matched at this tick, by those in `e.last.matches` and `in_images`; a
/// body without a match keeps those of its last one.
void note_matched(Estimate& estimate, const std::vector<Match>& in_images, const EstimatorSettings& settings);

/// The median, by their ratio, of the sigmas relative to what a body matched last; nothing when none of it is mapped any
/// more. For an inverse depth, which is still being estimated, only the part across the line of sight counts.
std::optional<RelativeSigma> relative_sigma(const Estimate& estimate, std::size_t body,
                                            const EstimatorSettings& settings);

}  // namespace incognita
