// One depth line on a synthetic wall, and a camera that moves before it.
#pragma once

#include <gtest/gtest.h>

#include <utility>

#include "incognita/slam/features/depth_line.hpp"
#include "tests/slam/synthetic_scene.hpp"

namespace incognita::synthetic {

inline const Wall wall(2);

inline CameraSlamSettings with_lines(double sigma_pixel_px = 0.5) {
  CameraSlamSettings settings = few_features();
  settings.initialization.method = InitializationSettings::Method::depth_line;
  settings.filter.sigma_pixel_px = sigma_pixel_px;
  return settings;
}

/// One line begun at the origin; the camera's pose has every correlation.
struct DepthLineScene : Tracking {
  SummedImage summed;
  Image image;
  Eigen::Vector3d truth;

  explicit DepthLineScene(std::size_t corner = 40, const CameraSlamSettings& settings = with_lines(),
                          const CameraCov& P = correlated_covariance(1e-3, 5))
      : Tracking(origin, P, settings) {
    truth = wall.corners_in_view(origin, 40).at(corner);
    EXPECT_TRUE(initialize(wall.seen_from(origin), pixel_of(origin, truth)));
  }
  CameraSlamSettings& settings() { return tracked.settings; }
  Landmark& line() { return landmark(0); }
  Feature& appearance() { return feature(0); }
  const std::vector<RayMatch>& matches() const { return tracked.ray_matches; }
  void follow(const CameraState& from, const Wall& predictions = wall) {
    follow_in(from, predictions.seen_from(from));
  }
  void follow_in(const CameraState& from, Image of) {
    image = std::move(of);
    summed.assign(image);
    move_to(from);
    tracked.ray_matches.clear();
    tracked.ray_particles.clear();
    update_depth_lines(summed, estimate, tracked);
  }
};

inline CameraState aside(double m) { return camera_at({0, m, 0}); }

}  // namespace incognita::synthetic
