// The product of the errors of inverse depth and camera position, which linearization leaves out.
#include <gtest/gtest.h>

#include "incognita/slam/features/predict_matches.hpp"
#include "tests/slam/synthetic_scene.hpp"

namespace incognita {
namespace {

using namespace synthetic;

/// A landmark of unknown depth, initialized where the camera was exactly, and the camera then somewhere within 0.3 m.
struct UnknownDepth : Tracking {
  static constexpr double sigma_m = 0.3;
  static CameraCov exact() { return 1e-10 * CameraCov::Identity(); }

  UnknownDepth() : Tracking(camera_at({0, 0, 0}), exact()) {
    tracked.settings.initialization.second_order = true;
    initialize(Wall(2).seen_from(camera_at({0, 0, 0})), {170, 130});
    CameraCov noise = CameraCov::Zero();
    noise.topLeftCorner<3, 3>() = sigma_m * sigma_m * Eigen::Matrix3d::Identity();
    estimate.belief.predict({camera_block(), camera_at({0, 0, 0}), CameraCov::Identity(), noise});
    tracked.view = viewpoint(estimate, tracked);
  }
  Eigen::Matrix2d spread(bool second_order) {
    tracked.settings.initialization.second_order = second_order;
    predict_matches(estimate, tracked);
    return tracked.matches.at(0).innovation_cov;
  }
};

/// Against draws of the depth and the position, projected exactly.
TEST(SecondOrder, InnovationCovarianceIsThatOfTheDraws) {
  UnknownDepth t;
  const Landmark& landmark = t.estimate.landmarks.begin()->second;
  const InverseDepthLandmark form{landmark.form.initial_axes};
  const InverseDepthLandmark::State y = t.estimate.belief.mean(landmark.block);
  const double sigma_inverse_depth = std::sqrt(t.estimate.belief.covariance(landmark.block)(5, 5));
  RandomStream random(1, "draws");
  Eigen::Vector2d sum(0, 0);
  Eigen::Matrix2d squares = Eigen::Matrix2d::Zero();
  const Eigen::Vector2d middle = form.predict_measurement(camera, camera_at({0, 0, 0}), y)->pixel;
  constexpr int draws = 20000;
  for (int k = 0; k < draws; ++k) {
    InverseDepthLandmark::State drawn = y;
    drawn[5] += sigma_inverse_depth * random.normal();
    // Across the line of sight, in which the measurement is bilinear
    const Eigen::Vector3d moved(0, UnknownDepth::sigma_m * random.normal(),
                                UnknownDepth::sigma_m * random.normal());
    const Eigen::Vector2d off = form.predict_measurement(camera, camera_at(moved), drawn)->pixel - middle;
    sum += off;
    squares += off * off.transpose();
  }
  const Eigen::Matrix2d cov = squares / draws - sum * sum.transpose() / draws / draws;
  const Eigen::Matrix2d first = t.spread(false), second = t.spread(true);
  EXPECT_NEAR(second(0, 0) / cov(0, 0), 1, 0.08);
  EXPECT_NEAR(second(1, 1) / cov(1, 1), 1, 0.08);
  EXPECT_LT(first(0, 0), 0.7 * cov(0, 0)) << "linearization alone is overconfident";
}

TEST(SecondOrder, IsNothingForPoints) {
  Tracking t(camera_at({0, 0, 0}), CameraCov(1e-4 * CameraCov::Identity()));
  t.tracked.settings.initialization.second_order = true;
  const Wall wall(2);
  const Eigen::Vector3d at = wall.corners_in_view(camera_at({0, 0, 0}), 60).front();
  t.add_point(wall.seen_from(camera_at({0, 0, 0})), camera_at({0, 0, 0}), at, at, 0.01);
  predict_matches(t.estimate, t.tracked);
  ASSERT_EQ(t.tracked.matches.size(), 1u);
  EXPECT_TRUE(t.tracked.matches[0].second_order_cov.isZero(0));
}

}  // namespace
}  // namespace incognita
