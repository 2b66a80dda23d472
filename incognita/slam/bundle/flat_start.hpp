// Other starts of bundle adjustment, without motion. From equal depths adjustment converges after a small motion where a filter, or the
// relative pose of two views, has taken a rotation for a translation: Yu and Gallup, "3D reconstruction from accidental motion"
// (2014). It may converge to the reversed depths, what is near far away and the translation backward, which fit nearly as well.
#pragma once

#include "incognita/models/sensors/camera.hpp"
#include "incognita/slam/bundle/bundle.hpp"

namespace incognita {

/// The bundle with all views at the first, and its points on the rays of their hosts at the median inverse depth of the priors.
/// Fixed views stay, and points of other parametrizations.
Bundle flat_start(Bundle bundle, const Camera& camera);

/// The same with the depths of the bundle reversed: inverse depths mirrored at their median.
Bundle reversed_start(Bundle bundle, const Camera& camera);

/// Each point in inverse depth on the ray of its host, at this inverse depth, 1/m.
void put_on_rays(Bundle& bundle, const Camera& camera, double inverse_depth);

}  // namespace incognita
