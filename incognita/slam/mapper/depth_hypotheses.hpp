// The depth of a new landmark as weighted hypotheses on its ray, thesis C.3: re-weighted by every match, until their standard
// deviation is small against their mean.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "incognita/models/sensors/camera_measurement.hpp"
#include "incognita/slam/mapper/estimate.hpp"
#include "incognita/slam/mapper/settings.hpp"

namespace incognita {

class StateArchive;

/// A depth hypothesis on a ray: inverse depth along the initial optical axis, 1/m, and its probability.
struct DepthHypothesis {
  double inverse_depth = 0;
  double weight = 0;
  void state(StateArchive& archive);
};

/// Hypotheses at equal distances from each other. `ray_length`: of the ray (x, y, 1), per depth along the optical axis.
std::vector<DepthHypothesis> uniform_depths(const DepthRange& range, double ray_length);

/// The mean depth of a ray along its initial optical axis, and its standard deviation, m.
struct RayDepth {
  double mean = 0, sigma = 0;
};
RayDepth depth_of(const std::vector<DepthHypothesis>& hypotheses);

/// The depth, once its standard deviation is less than `ratio` of it.
std::optional<RayDepth> converged_depth(const std::vector<DepthHypothesis>& hypotheses, double ratio);

/// The mean of a ray at one of its depths, as that of an inverse-depth landmark.
InverseDepthLandmark::State ray_at(const Landmark& ray, const AnyBelief& belief, double inverse_depth);

/// A hypothesis as predicted in the image.
struct PredictedHypothesis {
  std::size_t depth = 0;  ///< index among the hypotheses of the ray
  Eigen::Vector2d pixel{0.0, 0.0};
  Eigen::Matrix2d innovation_cov = Eigen::Matrix2d::Identity();  ///< px^2

  /// Squared Mahalanobis distance of a match.
  double distance2(const Eigen::Vector2d& found) const;
};

/// The predicted hypotheses, of which there must be one, as one Gaussian in the image, for display.
struct PredictedRay {
  Eigen::Vector2d pixel{0.0, 0.0};
  Eigen::Matrix2d innovation_cov = Eigen::Matrix2d::Zero();  ///< px^2
};
PredictedRay predicted_ray(const std::vector<DepthHypothesis>& depths,
                           std::span<const PredictedHypothesis> predicted);

/// The predicted hypotheses with their weights, for display.
void append_particles(const std::vector<DepthHypothesis>& depths,
                      std::span<const PredictedHypothesis> predicted, std::vector<DepthParticle>& particles);

/// Bayes update of the weights by the likelihood of a match. Removes the hypotheses that were not predicted, and those of
/// weights below a twentieth of the mean weight. False, and no change, when no hypothesis explains the match.
bool reweight(std::vector<DepthHypothesis>& depths, std::span<const PredictedHypothesis> predicted,
              const Eigen::Vector2d& found);

/// Converts a ray to a point with the Gaussian of its hypotheses; the quantization of their spacing is added.
void convert_to_point(AnyBelief& belief, Landmark& ray, const RayDepth& depth, double spacing_m);

}  // namespace incognita
