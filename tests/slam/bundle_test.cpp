#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "incognita/math/random.hpp"
#include "incognita/models/sensors/wide_angle_camera.hpp"
#include "incognita/slam/bundle/adjust_bundle.hpp"

namespace incognita {
namespace {

const Camera camera{WideAngleCamera{}};
constexpr double sigma_px = 0.5;

/// Six views from a line look at 30 points, every other of them in inverse depth; one point is known.
struct BundleScene {
  Bundle truth, start;

  explicit BundleScene(std::uint64_t seed, double noise_px = sigma_px) : random(seed, "bundle") {
    for (int i = 0; i < 6; ++i) truth.views.push_back(view(0.1 * i));
    for (int i = 0; i < 31; ++i) add_point(i, noise_px);
    truth.first_view = truth.views.front();
    truth.first_view_cov = 1e-8 * Eigen::Matrix<double, 6, 6>::Identity();
    start = truth;
    for (std::size_t i = 1; i < start.views.size(); ++i) start.views[i].position += 0.02 * normals<3>();
    for (BundlePoint& point : start.points)
      if (point.kind == BundlePoint::Kind::point)
        point.value += 0.05 * normals<3>();
      else if (point.kind == BundlePoint::Kind::inverse_depth)
        point.value[2] *= 1.3;
  }

 private:
  template <int size>
  Eigen::Matrix<double, size, 1> normals() {
    Eigen::Matrix<double, size, 1> v;
    for (double& number : v) number = random.normal();
    return v;
  }

  BundleView view(double x) {
    BundleView v;
    v.position = {x, 0.05 * random.normal(), 0.05 * random.normal()};
    v.world_from_camera = quaternion_exp<double>(0.05 * normals<3>());
    return v;
  }

  void add_point(int i, double noise_px) {
    const Eigen::Vector3d at(random.uniform(-0.7, 1.2), random.uniform(-0.7, 0.7), random.uniform(1.5, 3.0));
    BundlePoint point;
    point.kind = i == 30      ? BundlePoint::Kind::fixed
                 : i % 2 == 0 ? BundlePoint::Kind::point
                              : BundlePoint::Kind::inverse_depth;
    point.value = at;
    if (point.kind == BundlePoint::Kind::inverse_depth) {
      point.host = 2;
      point.initial_axes = truth.views[2].world_from_camera;
      const Eigen::Vector3d along =
          rotation_matrix(point.initial_axes).transpose() * (at - truth.views[2].position);
      point.value = {along.x() / along.z(), along.y() / along.z(), 1 / along.z()};
      point.prior_inverse_depth = 0.5;
      point.sigma_prior_inverse_depth = 0.5;
    }
    for (int v = 0; v < 6; ++v) {
      CameraState x = CameraState::Zero();
      x << truth.views[static_cast<std::size_t>(v)].position,
          truth.views[static_cast<std::size_t>(v)].world_from_camera, Eigen::Matrix<double, 6, 1>::Zero();
      const auto seen = PointLandmark::predict_measurement(camera, x, at);
      if (!seen) continue;
      truth.observations.push_back(
          {v, i, seen->pixel + noise_px * normals<2>(), sigma_px * sigma_px * Eigen::Matrix2d::Identity()});
    }
    truth.points.push_back(point);
  }

  RandomStream random;
};

TEST(BundleAdjustment, FindsTheTruthWithoutNoise) {
  BundleScene scene(1, 0);
  for (BundlePoint& point : scene.start.points)
    point.sigma_prior_inverse_depth = std::numeric_limits<double>::infinity();
  BundleEquations equations;
  const AdjustmentReport report =
      adjust(scene.start, camera, {.max_iterations = 30, .min_relative_decrease = 1e-12}, equations);
  ASSERT_NE(report.outcome, AdjustmentReport::Outcome::refused);
  EXPECT_GT(report.first_cost, 1000);
  EXPECT_LT(report.last_cost, 1e-9);
  for (std::size_t i = 0; i < 6; ++i)
    EXPECT_LT((scene.start.views[i].position - scene.truth.views[i].position).norm(), 1e-6) << i;
  for (std::size_t i = 0; i < 31; ++i)
    EXPECT_LT((scene.start.points[i].value - scene.truth.points[i].value).norm(), 1e-5) << i;
}

/// The gradient of the cost by the error of one number, by central differences.
template <class Move>
double slope(const Bundle& bundle, const Move& move) {
  constexpr double step = 1e-6;
  Bundle plus = bundle, minus = bundle;
  move(plus, step);
  move(minus, -step);
  return (cost_of(plus, camera, {}) - cost_of(minus, camera, {})) / (2 * step);
}

TEST(BundleAdjustment, EndsWhereTheCostIsFlat) {
  BundleScene scene(2);
  BundleEquations equations;
  const AdjustmentReport report =
      adjust(scene.start, camera, {.max_iterations = 50, .min_relative_decrease = 1e-13}, equations);
  ASSERT_EQ(report.outcome, AdjustmentReport::Outcome::converged);
  for (std::size_t v = 0; v < 6; ++v)
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(slope(scene.start, [&](Bundle& b, double d) { b.views[v].position[k] += d; }), 0, 0.05);
      EXPECT_NEAR(slope(scene.start,
                        [&](Bundle& b, double d) {
                          BundleView& view = b.views[v];
                          view.world_from_camera = quaternion_product(
                              view.world_from_camera, quaternion_exp<double>(d * Eigen::Vector3d::Unit(k)));
                        }),
                  0, 0.05);
    }
  for (std::size_t i = 0; i < 30; ++i)
    for (int k = 0; k < 3; ++k)
      EXPECT_NEAR(slope(scene.start, [&](Bundle& b, double d) { b.points[i].value[k] += d; }), 0, 0.05);
}

/// Fixed views are part of the measurements of the others, which find the truth without noise.
TEST(BundleAdjustment, LeavesFixedViewsWhereTheyAre) {
  BundleScene scene(5, 0);
  for (const std::size_t v : {0, 2, 3}) {
    scene.start.views[v] = scene.truth.views[v];
    scene.start.views[v].fixed = true;
  }
  for (BundlePoint& point : scene.start.points)
    point.sigma_prior_inverse_depth = std::numeric_limits<double>::infinity();
  BundleEquations equations;
  const AdjustmentReport report =
      adjust(scene.start, camera, {.max_iterations = 30, .min_relative_decrease = 1e-12}, equations);
  ASSERT_NE(report.outcome, AdjustmentReport::Outcome::refused);
  EXPECT_LT(report.last_cost, 1e-9);
  for (std::size_t v = 0; v < 6; ++v) {
    const double off = (scene.start.views[v].position - scene.truth.views[v].position).norm();
    if (scene.start.views[v].fixed)
      EXPECT_EQ(off, 0) << v;
    else
      EXPECT_LT(off, 1e-6) << v;
  }
}

TEST(BundleAdjustment, RefusesAViewWithoutMeasurements) {
  BundleScene scene(3);
  std::erase_if(scene.start.observations, [](const BundleObservation& o) { return o.view == 5; });
  const Bundle before = scene.start;
  BundleEquations equations;
  EXPECT_EQ(adjust(scene.start, camera, {}, equations).outcome, AdjustmentReport::Outcome::refused);
  EXPECT_EQ(scene.start.views[3].position, before.views[3].position);
}

TEST(BundleAdjustment, OutliersMoveItLittle) {
  BundleScene scene(4, 0.1);
  for (std::size_t i = 0; i < scene.start.observations.size(); i += 10)
    scene.start.observations[i].pixel += Eigen::Vector2d(15, -8);
  BundleEquations equations;
  adjust(scene.start, camera, {.max_iterations = 50, .min_relative_decrease = 1e-10}, equations);
  const double with_huber = (scene.start.views[5].position - scene.truth.views[5].position).norm();
  adjust(scene.start, camera,
         {.max_iterations = 50, .min_relative_decrease = 1e-10, .robust = {.limit_sigmas = 1e9}}, equations);
  const double without = (scene.start.views[5].position - scene.truth.views[5].position).norm();
  EXPECT_LT(with_huber, 0.5 * without);
}

}  // namespace
}  // namespace incognita
