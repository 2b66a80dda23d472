// One depth line on a synthetic wall, and a camera that moves before it.
#pragma once

#include <gtest/gtest.h>

#include <utility>

#include "incognita/slam/features/depth_line.hpp"
#include "tests/slam/synthetic_scene.hpp"

namespace incognita::synthetic {

inline const Wall wall(2);
inline const CameraState origin = camera_at({0, 0, 0});

inline CameraSlamSettings with_lines() {
  CameraSlamSettings settings;
  settings.initialization.method = InitializationSettings::Method::depth_line;
  settings.filter.sigma_pixel_px = 0.5;
  return settings;
}

/// One line begun at the origin; the camera's pose has every correlation.
struct DepthLineScene {
  CameraSlamSettings settings = with_lines();
  Estimate estimate = estimate_at(origin, correlated_covariance(1e-3, 5));
  SummedImage summed;
  Image image;
  Eigen::Vector3d truth;

  explicit DepthLineScene(std::size_t corner = 40, const CameraSlamSettings& s = with_lines()) : settings(s) {
    truth = wall.corners_in_view(origin, 40).at(corner);
    EXPECT_TRUE(
        initialize_landmark(wall.seen_from(origin), pixel_of(origin, truth), estimate, camera, settings));
  }
  Landmark& line() { return estimate.catalog.at(0); }
  void follow(const CameraState& from, const Wall& predictions = wall) {
    follow_in(from, predictions.seen_from(from));
  }
  void follow_in(const CameraState& from, Image of) {
    image = std::move(of);
    summed.assign(image);
    move_camera(estimate, from);
    estimate.line_matches.clear();
    update_depth_lines(summed, estimate, camera, settings);
  }
};

inline CameraState aside(double m) { return camera_at({0, m, 0}); }

}  // namespace incognita::synthetic
