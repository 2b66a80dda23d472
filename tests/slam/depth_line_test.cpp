// The depth of a new landmark by hypotheses on its line of sight (thesis C.3): reweighted by Bayes, pruned,
// made a point when sigma/depth is small.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <numbers>

#include "tests/slam/depth_line_scene.hpp"

namespace incognita {
namespace {

using namespace synthetic;
using Scene = DepthLineScene;

/// The point of a line at a hypothesis, from errors of the line's five parameters.
Eigen::Vector3d point_on(const Landmark& line, const AnyBelief& belief, double inverse_depth,
                         const Eigen::VectorXd& errors = Eigen::VectorXd::Zero(5)) {
  const Eigen::VectorXd y = Eigen::VectorXd(belief.mean(line.block)) + errors;
  return y.head<3>() +
         rotation_matrix<double>(line.form.initial_axes) * Eigen::Vector3d(y[3], y[4], 1) / inverse_depth;
}

struct Hypothesis {
  double inverse_depth, weight;
};

/// Bayes as the thesis has it: weight times N(found; h_i, H P H' + R), those out of view or below a twentieth
/// of the uniform weight left out.
std::vector<Hypothesis> reweighted(const Tracking& before, const Eigen::Vector2d& found) {
  const Estimate& e = before.estimate;
  const Landmark& line = before.landmark(0);
  const CameraSlamSettings& settings = before.tracked.settings;
  const BlockId block = before.camera_block();
  Eigen::MatrixXd P(17, 17);
  P << e.belief.covariance(block), e.belief.covariance(block, line.block),
      e.belief.covariance(line.block, block), e.belief.covariance(line.block);
  std::vector<Hypothesis> all;
  double total = 0;
  for (const DepthHypothesis& particle : before.feature(0).depths) {
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
  Tracking before = scene;
  before.move_to(from);
  scene.settings().initialization.depth_ratio = 1e-6;  // stay a line
  scene.follow(from);
  ASSERT_EQ(scene.matches().size(), 1u);
  const RayMatch& match = scene.matches()[0];
  ASSERT_EQ(match.outcome, MatchOutcome::matched);
  EXPECT_LT((*match.measured - pixel_of(from, scene.truth)).norm(), 0.5);
  const Eigen::Vector3d nearest =
      point_on(before.landmark(0), before.estimate.belief, before.feature(0).depths[0].inverse_depth);
  EXPECT_FALSE(camera.contains(pixel_of(from, nearest), 6))
      << "or the test does not look at those out of view";

  // For display: the hypotheses in view, as they were before the match
  const std::vector<DepthParticle>& shown = scene.tracked.ray_particles;
  ASSERT_EQ(match.first_particle, 0);
  ASSERT_EQ(static_cast<std::size_t>(match.particle_count), shown.size());
  EXPECT_LT(shown.size(), before.feature(0).depths.size());
  EXPECT_GT(shown.size(), 50u);
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  double share = 0;
  for (const DepthParticle& particle : shown) {
    mean += particle.weight * particle.pixel;
    share += particle.weight;
    EXPECT_EQ(particle.weight, before.feature(0).depths[0].weight) << "uniform at first";
  }
  EXPECT_LT((mean / share - match.predicted).norm(), 1e-9);
  const DepthHypothesis& last = before.feature(0).depths.back();
  const Eigen::Vector3d farthest = point_on(before.landmark(0), before.estimate.belief, last.inverse_depth);
  EXPECT_LT((shown.back().pixel - pixel_of(from, farthest)).norm(), 1e-9);

  const auto expected = reweighted(before, *match.measured);
  const auto& particles = scene.appearance().depths;
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
  EXPECT_EQ(scene.estimate.belief.mean(scene.camera_block()),
            before.estimate.belief.mean(before.camera_block()));
}

/// Small moves to the side: a line until sigma/depth is small, then the Gaussian of its hypotheses.
TEST(DepthLine, BecomesAPointWhenSigmaOverDepthIsSmall) {
  for (const std::size_t corner : {20u, 40u, 60u}) {
    Scene scene(corner);
    for (int k = 1;; ++k) {
      ASSERT_LT(k, 20) << "it does not converge";
      const CameraState from = aside(0.01 * k);
      Tracking before = scene;
      before.move_to(from);
      scene.follow(from);
      ASSERT_EQ(scene.estimate.landmarks.size(), 1u);
      const Landmark& line = before.landmark(0);
      const auto hypotheses = reweighted(before, *scene.matches().at(0).measured);
      const Depth depth = depth_of(hypotheses);
      const bool converged = depth.sigma < scene.settings().initialization.depth_ratio * depth.mean;
      ASSERT_EQ((scene.line().form.kind == Kind::point), converged) << k;
      if (!converged) continue;

      EXPECT_GT(k, 1) << "one look is not enough here";
      EXPECT_TRUE(scene.appearance().depths.empty());
      EXPECT_EQ(scene.line().id, line.id);
      const BlockId block = scene.line().block;
      const Eigen::Vector3d mean = point_on(line, before.estimate.belief, 1 / depth.mean);
      EXPECT_TRUE(Eigen::Vector3d(scene.estimate.belief.mean(block)).isApprox(mean, 1e-4));
      const Eigen::MatrixXd J = numeric_jacobian(5, 1e-6, [&](const Eigen::VectorXd& e) {
        return Eigen::VectorXd(point_on(line, before.estimate.belief, 1 / depth.mean, e));
      });
      const Eigen::Vector3d along = (mean - before.estimate.belief.mean(line.block).head<3>()) / depth.mean;
      const double spacing_m = 4.5 / 100;  // the resolution of the hypotheses
      const Eigen::Matrix3d P =
          J * before.estimate.belief.covariance(line.block) * J.transpose() +
          (depth.sigma * depth.sigma + spacing_m * spacing_m / 12) * along * along.transpose();
      const Eigen::Matrix3d cov = scene.estimate.belief.covariance(block);
      EXPECT_TRUE(cov.isApprox(P, 1e-3)) << cov << "\nexpected\n" << P;
      const Eigen::MatrixXd cross = scene.estimate.belief.covariance(block, scene.camera_block());
      EXPECT_TRUE(
          cross.isApprox(J * before.estimate.belief.covariance(line.block, before.camera_block()), 1e-3));
      const Eigen::Vector3d error = scene.truth - mean;
      EXPECT_LT(error.dot(cov.inverse() * error), 12) << error.transpose();
      break;
    }
  }
}

/// Just below the ratio it is a point, just above a line.
TEST(DepthLine, TheRatioOfSigmaToDepthDecides) {
  const CameraState from = aside(0.05);
  Scene dry(40);
  Tracking before = dry;
  before.move_to(from);
  dry.follow(from);
  const auto measured = dry.matches().at(0).measured;
  ASSERT_TRUE(measured);
  const Depth depth = depth_of(reweighted(before, *measured));
  for (const double factor : {0.995, 1.005}) {
    Scene scene(40);
    scene.settings().initialization.depth_ratio = factor * depth.sigma / depth.mean;
    scene.follow(from);
    EXPECT_EQ(scene.line().form.kind, factor < 1 ? Kind::ray : Kind::point);
  }
}

}  // namespace
}  // namespace incognita
