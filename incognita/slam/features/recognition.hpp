// Recognition of landmarks anywhere in an image, without a prediction: descriptors of the views under which they were
// matched, and of the corners of the image.
#pragma once

#include <vector>

#include "incognita/slam/features/feature.hpp"
#include "incognita/slam/features/pose_hypotheses.hpp"

namespace incognita {

/// Describes the features that this frame matched from a new direction or distance, a few per frame. To be called after
/// the correction, with the view of the corrected camera.
void describe_new_views(const Image& image, const Estimate& estimate, TrackedCamera& camera);

struct RecognitionLimits {
  int max_corners = 400;            ///< of an image
  double max_distance = 330;        ///< of descriptors, of length 512
  int candidates_per_landmark = 3;  ///< corners that may be the same landmark
  int landmarks_per_corner = 6;     ///< that a corner may be taken for: places may look alike
  double distinctive_ratio = 0.8;   ///< of the distance of descriptors to that of the next alike
  double max_sigma_share = 0.15;    ///< of the position of a landmark, relative to its distance
};

/// Corners of the image that look like landmarks with a known position. The most alike first.
std::vector<PointMatch> recognize_landmarks(const Image& image, const Estimate& estimate,
                                            const TrackedCamera& camera, const RecognitionLimits& limits);

}  // namespace incognita
