// Landmarks in the belief: added, converted to points, and removed. The front ends decide which; only these functions
// change the belief.
#pragma once

#include "incognita/messages/observation.hpp"
#include "incognita/slam/mapper/estimate.hpp"
#include "incognita/slam/mapper/settings.hpp"

namespace incognita {

/// A new landmark as a function of one body: mean, d(error) / d(error of the body), and the covariance of the rest.
struct NewLandmark {
  Chart chart;
  SmallVector mean;
  BlockId body = 0;
  SmallMatrix by_body;
  SmallMatrix noise;
};

/// Adds the landmark to belief and map, (2.20)-(2.26), under its id.
void add_landmark(Estimate& estimate, Landmark landmark, const NewLandmark& initialized);

/// Replaces the block of a landmark by a point: `J` = d(position) / d(errors of the block); `noise` is added.
void convert_to_point(AnyBelief& belief, Landmark& landmark, const SmallVector& position,
                      const SmallMatrix& J, const SmallMatrix& noise);

/// Removes the landmark from belief and map.
void remove_landmark(Estimate& estimate, std::int64_t id);

/// Adds the landmark of a detection by a point sensor under the identity of the detection, with EstimatorSettings::depth_lines
/// as a ray. False when the detection does not define one.
bool initialize_from_detection(Estimate& estimate, int body, const PointDetection& detection,
                               const EstimatorSettings& settings);

/// Converts converged inverse depths of landmarks that no camera tracks to points, and removes those that became
/// negative.
void convert_converged_inverse_depths(Estimate& estimate, const EstimatorSettings& settings);

}  // namespace incognita
