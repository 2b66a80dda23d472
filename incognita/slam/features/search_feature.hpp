// The search for one feature in an image, from coarse to fine.
//
// A small search ellipse is searched whole at full resolution, as in thesis C.2. For a large one most of the ellipse is
// improbable once the whole image has been aligned with the previous one: the neighborhood of the aligned position is
// searched first. Without a match there, the whole ellipse is searched at the resolution at which it is small, and what is
// found is refined level by level. Last, the patch is aligned with the image at a fraction of a pixel.
#pragma once

#include <optional>

#include "incognita/slam/features/feature.hpp"
#include "incognita/vision/pyramid.hpp"

namespace incognita {

/// Where the alignment of whole images expects the feature; nothing without an alignment.
std::optional<Eigen::Vector2d> guided_pixel(const FeatureMatch& match, const TrackedCamera& camera);

/// The best correlation of the feature's patch; nothing where its patch cannot be warped or no pixel can be tried. The
/// caller thresholds the correlation.
std::optional<Found> search_feature(CorrelationSheet& sheet, const ImagePyramid& pyramid,
                                    const PatchView& view, const FeatureMatch& match,
                                    const TrackedCamera& camera);

/// The same at one level only, in the ellipse or, if it is larger, around the aligned position; the result is in pixels of
/// level 0. For blurred images, in which patches match at a lower resolution only.
std::optional<Found> search_feature_at_level(CorrelationSheet& sheet, const ImagePyramid& pyramid,
                                             const PatchView& view, const FeatureMatch& match,
                                             const TrackedCamera& camera, int level);

}  // namespace incognita
