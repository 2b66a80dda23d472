// Landmark parametrizations: exact Jacobians, and initialization as the inverse of the measurement.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <vector>

#include "incognita/models/sensors/camera_measurement.hpp"
#include "tests/models/dual.hpp"
#include "tests/models/landmark_cases.hpp"

namespace incognita {
namespace {

template <class Model>
void check_point_prediction(const Model& model) {
  RandomStream random(1, "point looks");
  int seen = 0;
  for (const Vector3d& c : ordinary_and_nasty()) {
    const CameraState x = some_camera(random);
    const Vector3d point = to_world(x, c);
    const auto prediction = PointLandmark::predict_measurement(Camera(model), x, point);
    if (!prediction) continue;
    ++seen;
    constexpr int n = camera_errors + 3;
    const auto e = variables<n>(Eigen::Matrix<double, camera_errors, 1>::Zero().eval());
    const auto l = variables<n>(point, camera_errors);
    const Vector2<Dual<n>> pixel =
        model.template h<Dual<n>>(PointLandmark::in_camera<Dual<n>>(moved<Dual<n>>(x, e), l));
    const auto J = derivatives<n, 2>(pixel);
    expect_near(prediction->pixel, (values<n, 2>(pixel)), 1e-9);
    expect_near(prediction->Hv, J.template leftCols<camera_errors>(), 1e-8);
    expect_near(prediction->Hl, J.template rightCols<3>(), 1e-8);
  }
  EXPECT_GE(seen, 5);
}

TEST(PointMeasurement, JacobiansAreExact) {
  check_point_prediction(wide);
  check_point_prediction(pinhole);
  check_point_prediction(fisheye);
}

TEST(PointMeasurement, IsUndefinedBehindTheCamera) {
  RandomStream random(2, "behind");
  const CameraState x = some_camera(random);
  EXPECT_FALSE(PointLandmark::predict_measurement(Camera(wide), x, to_world(x, {0.1, 0, -1})));
  EXPECT_FALSE(PointLandmark::predict_measurement(Camera(wide), x, x.head<3>()));
}

struct Case {
  InverseDepthLandmark axes;
  InverseDepthLandmark::State y;
  CameraState x;
};

/// Landmarks initialized at one camera pose and measured from another near it, with inverse depths from
/// infinity to a centimeter.
std::vector<Case> inverse_depth_cases() {
  RandomStream random(3, "inverse depth");
  std::vector<Case> cases;
  for (const double rho : {0.0, 1e-12, 1e-4, 0.5, 2.0, 100.0, -0.05})
    for (const Vector2d& direction : {Vector2d(0, 0), Vector2d(0.3, -0.2), Vector2d(2.5, 1.5)})
      for (const double baseline : {0.0, 0.3}) {
        Case c;
        c.x = some_camera(random);
        c.axes.world_from_initial_camera = c.x.segment<4>(3);
        c.y << c.x.head<3>(), direction, rho;
        Vector3d turn, step;
        for (int i = 0; i < 3; ++i) {
          turn[i] = random.uniform(-0.3, 0.3);
          step[i] = random.uniform(-1, 1);
        }
        c.x.head<3>() += baseline * step;
        c.x.segment<4>(3) = quaternion_product<double>(c.x.segment<4>(3), quaternion_exp<double>(turn));
        cases.push_back(c);
      }
  return cases;
}

template <class Model>
void check_inverse_depth_prediction(const Model& model) {
  int seen = 0;
  for (const Case& c : inverse_depth_cases()) {
    const auto prediction = c.axes.predict_measurement(Camera(model), c.x, c.y);
    if (!prediction) continue;
    ++seen;
    constexpr int n = camera_errors + 6;
    const auto e = variables<n>(Eigen::Matrix<double, camera_errors, 1>::Zero().eval());
    const auto l = variables<n>(c.y, camera_errors);
    const Vector2<Dual<n>> pixel =
        model.template h<Dual<n>>(c.axes.in_camera<Dual<n>>(moved<Dual<n>>(c.x, e), l));
    const auto J = derivatives<n, 2>(pixel);
    expect_near(prediction->pixel, (values<n, 2>(pixel)), 1e-9);
    expect_near(prediction->Hv, J.template leftCols<camera_errors>(), 1e-8);
    expect_near(prediction->Hl, J.template rightCols<6>(), 1e-8);
  }
  EXPECT_GE(seen, 15);
}

TEST(InverseDepthMeasurement, JacobiansAreExact) {
  check_inverse_depth_prediction(wide);
  check_inverse_depth_prediction(pinhole);
  check_inverse_depth_prediction(fisheye);
}

TEST(InverseDepthMeasurement, EqualsThatOfTheSamePoint) {
  int seen = 0;
  for (const Case& c : inverse_depth_cases()) {
    if (!(c.y[5] > 0)) continue;
    const auto prediction = c.axes.predict_measurement(Camera(wide), c.x, c.y);
    const auto point = PointLandmark::predict_measurement(Camera(wide), c.x, c.axes.point(c.y).position);
    ASSERT_EQ(prediction.has_value(), point.has_value());
    if (!prediction) continue;
    ++seen;
    // a position 1e12 m away has a resolution of 1e-4 m, i.e. 1e-16 rad
    expect_near(prediction->pixel, point->pixel, 1e-9);
    expect_near(prediction->Hv, point->Hv, 1e-8);
  }
  EXPECT_GE(seen, 10);
}

TEST(InverseDepthMeasurement, AtInfinityOnlyRotationMatters) {
  for (Case c : inverse_depth_cases()) {
    if (c.y[5] != 0) continue;
    const auto here = c.axes.predict_measurement(Camera(wide), c.x, c.y);
    c.x.head<3>() += Vector3d(5, -7, 3);
    const auto there = c.axes.predict_measurement(Camera(wide), c.x, c.y);
    ASSERT_EQ(here.has_value(), there.has_value());
    if (!here) continue;
    EXPECT_EQ(here->pixel, there->pixel);
    EXPECT_EQ(here->Hv.leftCols<3>().norm(), 0);
    EXPECT_GT(here->Hv.middleCols<3>(3).norm(), 1);
  }
}

TEST(InverseDepthPoint, LiesOnTheRayAtItsDepth) {
  RandomStream random(4, "geometry");
  const CameraState x = some_camera(random);
  const Vector3d seen(0.4, -0.3, 2.5);  // in the axes of the initialization
  const InverseDepthLandmark axes{x.segment<4>(3)};
  InverseDepthLandmark::State y;
  y << x.head<3>(), seen.x() / seen.z(), seen.y() / seen.z(), 1 / seen.z();
  expect_near(axes.point(y).position, to_world(x, seen), 1e-14);
}

TEST(InverseDepthPoint, JacobianIsExact) {
  for (const Case& c : inverse_depth_cases()) {
    if (!(c.y[5] > 1e-6)) continue;
    const auto y = variables<6>(c.y);
    const Vector3<Dual<6>> ray(y[3], y[4], Dual<6>(1));
    const Vector3<Dual<6>> turned =
        rotation_matrix<Dual<6>>(c.axes.world_from_initial_camera.cast<Dual<6>>()) * ray;
    const Vector3<Dual<6>> position = y.head<3>() + turned / y[5];
    const auto point = c.axes.point(c.y);
    expect_near(point.position, (values<6, 3>(position)), 1e-12);
    expect_near(point.J, (derivatives<6, 3>(position)), 1e-12);
  }
}

std::vector<Vector2d> pixels_to_initialize_at() {
  return {{159.5, 119.5}, {160, 100}, {20, 200}, {0, 0}, {319, 239}, {319, 0}, {0, 119.5}};
}

TEST(Initialization, IsTheInverseOfTheMeasurement) {
  RandomStream random(5, "births");
  for (const Camera& camera : {Camera(wide), Camera(pinhole), Camera(fisheye)})
    for (const Vector2d& pixel : pixels_to_initialize_at())
      for (const double rho : {0.0, 1e-9, 0.5, 50.0}) {
        const CameraState x = some_camera(random);
        const auto initialized = InverseDepthLandmark::initialize(camera, x, pixel, rho);
        ASSERT_TRUE(initialized);
        EXPECT_EQ(initialized->landmark[5], rho);
        const auto prediction =
            InverseDepthLandmark{initialized->world_from_initial_camera}.predict_measurement(
                camera, x, initialized->landmark);
        ASSERT_TRUE(prediction);
        EXPECT_LT((prediction->pixel - pixel).norm(), 1e-8);
        // and to first order: a camera error displaces the landmark so that the pixel stays
        const Eigen::Matrix<double, 2, camera_errors> stays =
            prediction->Hv + prediction->Hl * initialized->Jv;
        EXPECT_LT(stays.norm(), 1e-7 * (1 + prediction->Hv.norm()));
        EXPECT_LT((prediction->Hl * initialized->Jz - Eigen::Matrix2d::Identity()).norm(), 1e-8);
      }
}

TEST(Initialization, JacobiansAreExact) {
  RandomStream random(6, "birth rays");
  for (const Vector2d& at : pixels_to_initialize_at()) {
    const CameraState x = some_camera(random);
    const auto initialized = InverseDepthLandmark::initialize(Camera(wide), x, at, 0.5);
    ASSERT_TRUE(initialized);
    constexpr int n = camera_errors + 2;
    using D = Dual<n>;
    const auto camera = moved<D>(x, variables<n>(Eigen::Matrix<double, camera_errors, 1>::Zero().eval()));
    const auto pixel = variables<n>(at, camera_errors);
    const D cu = pixel[0] - D(wide.u0), cv = pixel[1] - D(wide.v0);
    const D root = sqrt(D(1) - D(2 * wide.kd1) * (cu * cu + cv * cv));
    const Vector3<D> ray(cu / (root * D(wide.fu)), cv / (root * D(wide.fv)), D(1));
    const Vector3<D> in_world = rotation_matrix<D>(camera.template segment<4>(3)) * ray;
    const Vector3<D> in_initial_camera =
        rotation_matrix<D>(initialized->world_from_initial_camera.cast<D>()).transpose() * in_world;
    Eigen::Matrix<D, 6, 1> y;
    y << camera.template head<3>(), in_initial_camera[0] / in_initial_camera[2],
        in_initial_camera[1] / in_initial_camera[2], D(0.5);
    const auto J = derivatives<n, 6>(y);
    expect_near(initialized->landmark, (values<n, 6>(y)), 1e-12);
    expect_near(initialized->Jv, J.template leftCols<camera_errors>(), 1e-10);
    expect_near(initialized->Jz, J.template rightCols<2>(), 1e-10);
  }
}

TEST(Initialization, FailsWhereNoRayReaches) {
  // the image of infinity is a circle of radius 1/sqrt(2 kd1) = 236 px
  const CameraState x = (CameraState() << 0, 0, 0, 1, Eigen::Matrix<double, 9, 1>::Zero()).finished();
  EXPECT_TRUE(InverseDepthLandmark::initialize(Camera(wide), x, {159.5 + 235, 119.5}, 0.5));
  EXPECT_FALSE(InverseDepthLandmark::initialize(Camera(wide), x, {159.5 + 237, 119.5}, 0.5));
}

}  // namespace
}  // namespace incognita
