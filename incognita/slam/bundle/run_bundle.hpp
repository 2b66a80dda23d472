// The matches of a whole run as one bundle, for adjustment after its end.
#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "incognita/models/sensors/camera.hpp"
#include "incognita/slam/bundle/bundle.hpp"

namespace incognita {

inline constexpr std::size_t least_matches_of_landmark = 3;

struct RunMatches {
  std::vector<BundleView> views;  ///< as they were estimated during the run
  /// Of each landmark, the views in which it was matched, in their order, and where, px.
  std::map<std::int64_t, std::vector<std::pair<int, Eigen::Vector2d>>> pixels;
  std::map<std::int64_t, Eigen::Vector3d> known;  ///< positions of anchors, m
};

/// Anchors at their positions, and other landmarks of least_matches_of_landmark matches or more in inverse depth from their first view:
/// where their rays intersect or else, without parallax, at the median depth of the others. Anchors give frame and scale. Without any the
/// first view keeps its pose, and weak priors, of twice the inverse depth, hold the scale. `run`: of one view or more.
/// `sigma_pixel_px`: of each coordinate of all measurements.
Bundle bundle_of(const RunMatches& run, const Camera& camera, double sigma_pixel_px);

/// Distance of each measurement from its prediction, px, in the order of the bundle; infinite for points that are not in front of the
/// camera.
std::vector<double> residuals_px(const Bundle& bundle, const Camera& camera);

}  // namespace incognita
