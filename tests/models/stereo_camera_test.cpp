// Stereo camera: exact Jacobians, initialization as the inverse of the measurement, and refusals.
#include "incognita/models/sensors/stereo_camera.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "tests/models/dual.hpp"
#include "tests/models/landmark_cases.hpp"

namespace incognita {
namespace {

constexpr double baseline = 0.12;

/// Stereo measurement by definition: two lenses in one body.
template <class S, class Model>
Vector3<S> seen(const Model& model, const FreeCameraMotion::State<S>& left, const Vector3<S>& point) {
  const Vector3<S> c = PointLandmark::in_camera<S>(left, point);
  const Vector2<S> by_left = model.template h<S>(c);
  const Vector2<S> by_right = model.template h<S>(Vector3<S>(c - Vector3<S>(S(baseline), S(0), S(0))));
  return {by_left[0], by_left[1], by_right[0]};
}

template <class Model>
void check_prediction(const Model& model) {
  RandomStream random(1, "stereo looks");
  const StereoCamera stereo{Camera(model), baseline};
  int tried = 0;
  for (const Vector3d& c : ordinary_and_nasty()) {
    const CameraState x = some_camera(random);
    const Vector3d point = to_world(x, c);
    const auto prediction = stereo.predict_measurement(x, point);
    if (!prediction) continue;
    ++tried;
    constexpr int n = camera_errors + 3;
    const auto e = variables<n>(Eigen::Matrix<double, camera_errors, 1>::Zero().eval());
    const auto z =
        seen<Dual<n>>(model, moved<Dual<n>>(x, e), Vector3<Dual<n>>(variables<n>(point, camera_errors)));
    const auto J = derivatives<n, 3>(z);
    // a point a millimeter away has a resolution of 1e-16 m, relative 1e-13: 1e-10 pixels
    expect_near(prediction->z, (values<n, 3>(z)), 1e-9);
    expect_near(prediction->Hv, J.template leftCols<camera_errors>(), 1e-8);
    expect_near(prediction->Hl, J.template rightCols<3>(), 1e-8);
  }
  EXPECT_GE(tried, 5);
}

TEST(StereoMeasurement, JacobiansAreExact) {
  check_prediction(wide);
  check_prediction(WideAngleCamera{});
  check_prediction(pinhole);
}

TEST(StereoMeasurement, DisparityIsFocalLengthTimesBaselineOverDepth) {
  const PinholeCamera straight{};
  const StereoCamera stereo{Camera(straight), baseline};
  RandomStream random(2, "disparity");
  const CameraState x = some_camera(random);
  const auto prediction = stereo.predict_measurement(x, to_world(x, {0.2, 0.3, 2}));
  ASSERT_TRUE(prediction);
  EXPECT_NEAR(prediction->z[0] - prediction->z[2], straight.fu * baseline / 2, 1e-9);
  EXPECT_NEAR(prediction->z[1], prediction->right.y(), 1e-9) << "rows are the same without distortion";
}

TEST(StereoMeasurement, IsUndefinedBehindTheCamera) {
  RandomStream random(3, "behind");
  const CameraState x = some_camera(random);
  for (const Camera& camera : {Camera(wide), Camera(pinhole)})
    for (const Vector3d& c :
         {Vector3d(0, 0, -1), Vector3d(0.1, 0, -1e-6), Vector3d(0, 0, 0), Vector3d(NAN, 0, 1)}) {
      const auto prediction = StereoCamera{camera, baseline}.predict_measurement(x, to_world(x, c));
      EXPECT_FALSE(prediction && prediction->z.allFinite()) << c.transpose();
    }
}

TEST(StereoMeasurement, BothImagesMustContainThePoint) {
  const StereoCamera stereo{Camera(WideAngleCamera{}), baseline};
  const CameraState x = (CameraState() << 0, 0, 0, 1, Eigen::Matrix<double, 9, 1>::Zero()).finished();
  EXPECT_TRUE(stereo.contains(*stereo.predict_measurement(x, {0, 0, 1})));
  EXPECT_TRUE(stereo.camera.contains(stereo.predict_measurement(x, {-0.75, 0, 1})->z.head<2>()));
  EXPECT_FALSE(stereo.contains(*stereo.predict_measurement(x, {-0.75, 0, 1}))) << "left of the right image";
}

/// In camera axes: all over the image, and from 0.1 m to distances with little disparity.
std::vector<Vector3d> where_both_see() {
  std::vector<Vector3d> all;
  for (const double depth : {0.3, 1.0, 5.0, 25.0})
    for (const Vector2d& ray :
         {Vector2d(0, 0), Vector2d(0.5, 0.3), Vector2d(-0.4, -0.5), Vector2d(0.7, -0.5)})
      all.push_back(depth * Vector3d(ray.x(), ray.y(), 1));
  return all;
}

TEST(StereoInitialization, IsTheInverseOfTheMeasurement) {
  RandomStream random(4, "stereo births");
  for (const Camera& camera : {Camera(wide), Camera(WideAngleCamera{}), Camera(pinhole)})
    for (const Vector3d& c : where_both_see()) {
      const StereoCamera stereo{camera, baseline};
      const CameraState x = some_camera(random);
      const Vector3d point = to_world(x, c);
      const auto prediction = stereo.predict_measurement(x, point);
      ASSERT_TRUE(prediction);
      const auto initialized = stereo.initialize(x, prediction->z);
      ASSERT_TRUE(initialized) << c.transpose();
      EXPECT_LE((initialized->landmark - point).norm(), 1e-9 * c.squaredNorm()) << c.transpose();
      EXPECT_LE((prediction->Hl * initialized->Jz - Eigen::Matrix3d::Identity()).norm(), 1e-6);
    }
}

/// Against triangulation for lenses without distortion, written with dual numbers.
TEST(StereoInitialization, JacobiansAreThoseOfTriangulation) {
  constexpr int n = camera_errors + 3;
  using D = Dual<n>;
  const WideAngleCamera lens{};
  const StereoCamera stereo{Camera(lens), baseline};
  RandomStream random(5, "triangulation");
  for (const Vector3d& c : where_both_see()) {
    const CameraState x = some_camera(random);
    const auto prediction = stereo.predict_measurement(x, to_world(x, c));
    const auto initialized = stereo.initialize(x, prediction->z);
    ASSERT_TRUE(initialized);
    const auto z = variables<n>(prediction->z, camera_errors);
    const auto camera = moved<D>(x, variables<n>(Eigen::Matrix<double, camera_errors, 1>::Zero().eval()));
    const D depth = D(lens.fu * baseline) / (z[0] - z[2]);
    const Vector3<D> ray((z[0] - D(lens.u0)) / D(lens.fu), (z[1] - D(lens.v0)) / D(lens.fv), D(1));
    const Vector3<D> in_camera(ray[0] * depth, ray[1] * depth, depth);
    const Vector3<D> turned = rotation_matrix<D>(camera.template segment<4>(3)) * in_camera;
    const Vector3<D> point = camera.template head<3>() + turned;
    const auto J = derivatives<n, 3>(point);
    expect_near(initialized->landmark, (values<n, 3>(point)), 1e-9);
    expect_near(initialized->Jv, J.template leftCols<camera_errors>(), 1e-8);
    expect_near(initialized->Jz, J.template rightCols<3>(), 1e-8);
  }
}

TEST(StereoInitialization, FailsWithoutEnoughDisparity) {
  const CameraState x = (CameraState() << 0, 0, 0, 1, Eigen::Matrix<double, 9, 1>::Zero()).finished();
  for (const Camera& camera : {Camera(wide), Camera(pinhole)}) {
    const StereoCamera stereo{camera, baseline, 0.5}, eager{camera, baseline, 0};
    EXPECT_TRUE(stereo.initialize(x, {160, 120, 159}));
    EXPECT_FALSE(stereo.initialize(x, {160, 120, 159.5}));
    EXPECT_FALSE(stereo.initialize(x, {160, 120, 160}));
    EXPECT_FALSE(stereo.initialize(x, {160, 120, 170}));
    EXPECT_FALSE(eager.initialize(x, {160, 120, 160}));
    EXPECT_TRUE(eager.initialize(x, {160, 120, 159.9}));
    EXPECT_FALSE(stereo.initialize(x, {160, 120, NAN}));
    EXPECT_FALSE(stereo.initialize(x, {160, NAN, 150}));
  }
}

TEST(StereoInitialization, FailsWhereNoRayReaches) {
  // the image of infinity is a circle of radius 236 px
  const CameraState x = (CameraState() << 0, 0, 0, 1, Eigen::Matrix<double, 9, 1>::Zero()).finished();
  const StereoCamera stereo{Camera(wide), baseline};
  EXPECT_TRUE(stereo.initialize(x, {159.5, 119.5, 159.5 - 234}));
  EXPECT_FALSE(stereo.initialize(x, {159.5, 119.5, 159.5 - 237}));
  EXPECT_FALSE(stereo.initialize(x, {159.5 + 237, 119.5, 159.5}));
}

TEST(StereoCamera, InvalidParametersAreRefused) {
  EXPECT_NO_THROW((StereoCamera{Camera(wide)}.check()));
  for (const double bad : {0.0, -0.1, double(NAN), double(INFINITY)})
    EXPECT_THROW((StereoCamera{Camera(wide), bad}.check()), std::invalid_argument);
  EXPECT_THROW((StereoCamera{Camera(wide), 0.1, -1}.check()), std::invalid_argument);
}

}  // namespace
}  // namespace incognita
