// The depth of a new landmark by hypotheses on its line of sight (thesis C.3): reweighted by Bayes, pruned,
// made a point when sigma/depth is small, given up when nothing is found.
#include "incognita/slam/features/depth_line.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <numbers>

#include "tests/slam/synthetic_scene.hpp"

namespace incognita {
namespace {

using namespace synthetic;

const Wall wall(2);
const CameraState origin = camera_at({0, 0, 0});

CameraSlamSettings with_lines() {
  CameraSlamSettings settings;
  settings.birth.method = BirthSettings::Method::depth_line;
  settings.filter.sigma_pixel_px = 0.5;
  return settings;
}

/// One line begun at the origin; the camera's pose has every correlation.
struct Scene {
  CameraSlamSettings settings = with_lines();
  Estimate estimate = estimate_at(origin, correlated_covariance(1e-3, 5));
  SummedImage summed;
  Image image;
  Eigen::Vector3d truth;

  explicit Scene(std::size_t corner = 40, const CameraSlamSettings& s = with_lines()) : settings(s) {
    truth = wall.corners_in_view(origin, 40).at(corner);
    EXPECT_TRUE(give_birth(wall.seen_from(origin), pixel_of(origin, truth), estimate, camera, settings));
  }
  Landmark& line() { return estimate.catalogue.at(0); }
  void follow(const CameraState& from, const Wall& seen = wall) { follow_in(from, seen.seen_from(from)); }
  void follow_in(const CameraState& from, Image of) {
    image = std::move(of);
    summed.assign(image);
    move_camera(estimate, from);
    estimate.line_looks.clear();
    follow_lines(summed, estimate, camera, settings);
  }
};

CameraState aside(double m) { return camera_at({0, m, 0}); }

/// The point of a line at a hypothesis, from errors of the line's five parameters.
Eigen::Vector3d point_on(const Landmark& line, const Belief& belief, double inverse_depth,
                         const Eigen::VectorXd& errors = Eigen::VectorXd::Zero(5)) {
  const Eigen::VectorXd y = Eigen::VectorXd(belief.mean(line.block)) + errors;
  return y.head<3>() + rotation_matrix<double>(line.birth_axes.world_from_birth) *
                           Eigen::Vector3d(y[3], y[4], 1) / inverse_depth;
}

struct Hypothesis {
  double inverse_depth, weight;
};

/// Bayes as the thesis has it: weight times N(found; h_i, H P H' + R), those out of view or below a twentieth
/// of the uniform weight left out.
std::vector<Hypothesis> reweighted(const Estimate& e, const Landmark& line, const Eigen::Vector2d& found,
                                   const CameraSlamSettings& settings) {
  Eigen::MatrixXd P(17, 17);
  P << e.belief.covariance(e.camera), e.belief.covariance(e.camera, line.block),
      e.belief.covariance(line.block, e.camera), e.belief.covariance(line.block);
  std::vector<Hypothesis> all;
  double total = 0;
  for (const auto& particle : line.particles) {
    const auto pixel = [&](const Eigen::VectorXd& errors) {
      const CameraState x = plus(FreeCameraMotion::chart, e.camera_state(), Eigen::VectorXd(errors.head(12)));
      return Eigen::VectorXd(pixel_of(x, point_on(line, e.belief, particle.inverse_depth, errors.tail(5))));
    };
    const Eigen::Vector2d h = pixel(Eigen::VectorXd::Zero(17));
    if (!camera.contains(h, settings.search.patch_size_px / 2 + 1)) continue;
    const Eigen::MatrixXd H = numeric_jacobian(17, 1e-6, pixel);
    const Eigen::Matrix2d S =
        H * P * H.transpose() + std::pow(settings.filter.sigma_pixel_px, 2) * Eigen::Matrix2d::Identity();
    const Eigen::Vector2d r = found - h;
    const double likelihood =
        std::exp(-r.dot(S.inverse() * r) / 2) / (2 * std::numbers::pi * std::sqrt(S.determinant()));
    all.push_back({particle.inverse_depth, particle.weight * likelihood});
    total += all.back().weight;
  }
  const double least = 0.05 * total / static_cast<double>(all.size());
  std::erase_if(all, [&](const Hypothesis& h) { return h.weight < least; });
  total = 0;
  for (const Hypothesis& h : all) total += h.weight;
  for (Hypothesis& h : all) h.weight /= total;
  return all;
}

struct Depth {
  double mean = 0, sigma = 0;
};

Depth depth_of(const std::vector<Hypothesis>& hypotheses) {
  Depth depth;
  for (const Hypothesis& h : hypotheses) depth.mean += h.weight / h.inverse_depth;
  for (const Hypothesis& h : hypotheses)
    depth.sigma += h.weight * std::pow(1 / h.inverse_depth - depth.mean, 2);
  depth.sigma = std::sqrt(depth.sigma);
  return depth;
}

TEST(DepthLine, HypothesesAreReweightedByBayes) {
  // The corner is far to the right: moved to the left, the nearest hypotheses leave the image
  Scene scene(0);
  const CameraState from = aside(0.12);
  Estimate before = scene.estimate;
  move_camera(before, from);
  scene.settings.birth.depth_ratio = 1e-6;  // stay a line
  scene.follow(from);
  ASSERT_EQ(scene.estimate.line_looks.size(), 1u);
  const LineLook& look = scene.estimate.line_looks[0];
  ASSERT_EQ(look.outcome, LookOutcome::matched);
  EXPECT_LT((*look.measured - pixel_of(from, scene.truth)).norm(), 0.5);
  const Eigen::Vector3d nearest =
      point_on(before.catalogue[0], before.belief, before.catalogue[0].particles[0].inverse_depth);
  EXPECT_FALSE(camera.contains(pixel_of(from, nearest), 6))
      << "or the test does not look at those out of view";

  const auto expected = reweighted(before, before.catalogue[0], *look.measured, scene.settings);
  const auto& particles = scene.line().particles;
  ASSERT_EQ(particles.size(), expected.size());
  EXPECT_LT(particles.size(), 90u) << "pruned";
  EXPECT_GT(particles.size(), 5u);
  double total = 0;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    EXPECT_EQ(particles[i].inverse_depth, expected[i].inverse_depth);
    EXPECT_NEAR(particles[i].weight, expected[i].weight, 1e-4 * expected[i].weight + 1e-9);
    total += particles[i].weight;
  }
  EXPECT_NEAR(total, 1, 1e-12);
  EXPECT_EQ(scene.estimate.belief.errors(), 17) << "the match corrects no camera";
  EXPECT_EQ(scene.estimate.belief.mean(scene.estimate.camera), before.belief.mean(before.camera));
}

/// Small moves to the side: a line until sigma/depth is small, then the Gaussian of its hypotheses.
TEST(DepthLine, BecomesAPointWhenSigmaOverDepthIsSmall) {
  for (const std::size_t corner : {20u, 40u, 60u}) {
    Scene scene(corner);
    for (int k = 1;; ++k) {
      ASSERT_LT(k, 20) << "it does not converge";
      const CameraState from = aside(0.01 * k);
      Estimate before = scene.estimate;
      move_camera(before, from);
      scene.follow(from);
      ASSERT_EQ(scene.estimate.catalogue.size(), 1u);
      const Landmark& line = before.catalogue[0];
      const auto hypotheses =
          reweighted(before, line, *scene.estimate.line_looks.at(0).measured, scene.settings);
      const Depth depth = depth_of(hypotheses);
      const bool converged = depth.sigma < scene.settings.birth.depth_ratio * depth.mean;
      ASSERT_EQ(scene.line().kind == Landmark::Kind::point, converged) << k;
      if (!converged) continue;

      EXPECT_GT(k, 1) << "one look is not enough here";
      EXPECT_TRUE(scene.line().particles.empty());
      EXPECT_EQ(scene.line().id, line.id);
      const BlockId block = scene.line().block;
      const Eigen::Vector3d mean = point_on(line, before.belief, 1 / depth.mean);
      EXPECT_TRUE(Eigen::Vector3d(scene.estimate.belief.mean(block)).isApprox(mean, 1e-4));
      const Eigen::MatrixXd J = numeric_jacobian(5, 1e-6, [&](const Eigen::VectorXd& e) {
        return Eigen::VectorXd(point_on(line, before.belief, 1 / depth.mean, e));
      });
      const Eigen::Vector3d along = (mean - before.belief.mean(line.block).head<3>()) / depth.mean;
      const double spacing_m = 4.5 / 100;  // hypotheses can tell no less than uniform between two of them
      const Eigen::Matrix3d P =
          J * before.belief.covariance(line.block) * J.transpose() +
          (depth.sigma * depth.sigma + spacing_m * spacing_m / 12) * along * along.transpose();
      const Eigen::Matrix3d cov = scene.estimate.belief.covariance(block);
      EXPECT_TRUE(cov.isApprox(P, 1e-3)) << cov << "\nexpected\n" << P;
      const Eigen::MatrixXd cross = scene.estimate.belief.covariance(block, scene.estimate.camera);
      EXPECT_TRUE(cross.isApprox(J * before.belief.covariance(line.block, before.camera), 1e-3));
      const Eigen::Vector3d error = scene.truth - mean;
      EXPECT_LT(error.dot(cov.inverse() * error), 12) << error.transpose();
      break;
    }
  }
}

TEST(DepthLine, IsGivenUpAfterTooManyFailuresInARow) {
  Scene scene;
  scene.settings.birth.max_line_failures = 4;
  scene.settings.birth.depth_ratio = 1e-6;
  const Wall other(2, 99);
  for (int k = 1; k <= 3; ++k) {
    scene.follow(aside(0.02), other);
    ASSERT_EQ(scene.estimate.catalogue.size(), 1u);
    EXPECT_EQ(scene.estimate.line_looks.at(0).outcome, LookOutcome::not_found);
    EXPECT_EQ(scene.line().line_failures, k);
    EXPECT_EQ(scene.line().particles.size(), 100u) << "a failure says nothing of the depth";
  }
  scene.follow(aside(0.02));
  ASSERT_EQ(scene.estimate.line_looks.at(0).outcome, LookOutcome::matched);
  for (int k = 1; k <= 3; ++k) scene.follow(aside(0.02), other);
  ASSERT_EQ(scene.estimate.catalogue.size(), 1u) << "the match began the count anew";
  scene.follow(aside(0.02), other);
  EXPECT_TRUE(scene.estimate.catalogue.empty());
  EXPECT_EQ(scene.estimate.belief.errors(), 12) << "and its block is gone";
}

/// Out of view is a failure too, or it would be followed for ever.
TEST(DepthLine, OutOfViewIsGivenUpToo) {
  Scene scene;
  scene.settings.birth.max_line_failures = 3;
  for (int k = 0; k < 3; ++k) {
    ASSERT_EQ(scene.estimate.catalogue.size(), 1u);
    scene.follow(camera_at({0, 0, 0}, M_PI));
    EXPECT_TRUE(scene.estimate.line_looks.empty());
  }
  EXPECT_TRUE(scene.estimate.catalogue.empty());
}

/// Found 12 sigmas from the only hypothesis: no depth on the line explains that.
TEST(DepthLine, IsDroppedWhenNoHypothesisExplainsTheMatch) {
  for (const bool right : {false, true}) {
    Scene scene(40);
    scene.estimate = estimate_at(origin, 1e-10 * CameraCov::Identity());
    ASSERT_TRUE(give_birth(wall.seen_from(origin), pixel_of(origin, scene.truth), scene.estimate, camera,
                           scene.settings));
    scene.settings.search.gate_sigmas = 20;
    // Moved by 0.2 m: 19.5 px of parallax at 2 m, 6 px more at 1.53 m
    scene.line().particles = {{right ? 1 / 2.0 : 1 / 1.53, 1.0}};
    scene.follow(aside(0.2));
    ASSERT_EQ(scene.estimate.line_looks.size(), 1u);
    EXPECT_EQ(scene.estimate.line_looks[0].outcome, right ? LookOutcome::matched : LookOutcome::inconsistent);
    EXPECT_EQ(scene.estimate.catalogue.size(), right ? 1u : 0u);
    EXPECT_EQ(scene.estimate.belief.errors(), right ? 15 : 12);
  }
}

TEST(DepthLine, LeavesOtherLandmarksAlone) {
  Scene scene;
  const Eigen::Vector3d at = wall.point_at(origin, {90, 90});
  add_point(scene.estimate, wall.seen_from(origin), origin, at, at, 0.01, scene.settings);
  const Landmark& point = scene.estimate.catalogue[1];
  const Eigen::MatrixXd before = scene.estimate.belief.covariance(point.block);
  scene.settings.birth.max_line_failures = 1;
  scene.follow(aside(0.02), Wall(2, 99));
  ASSERT_EQ(scene.estimate.catalogue.size(), 1u);
  EXPECT_EQ(scene.line().kind, Landmark::Kind::point);
  EXPECT_EQ(scene.estimate.belief.covariance(scene.line().block), before);
  EXPECT_TRUE(scene.estimate.line_looks.size() == 1);
}

}  // namespace
}  // namespace incognita
