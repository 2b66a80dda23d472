// Inverse-depth landmarks of a stereo camera: exact Jacobians, initialization as the inverse of the
// measurement, points at infinity.
#include <gtest/gtest.h>

#include <cmath>

#include "incognita/models/sensors/stereo_camera.hpp"
#include "tests/models/dual.hpp"
#include "tests/models/landmark_cases.hpp"

namespace incognita {
namespace {

constexpr double baseline = 0.12;

/// A camera, and a landmark that was initialized from another pose.
struct Case {
  CameraState x;
  InverseDepthLandmark form;
  InverseDepthLandmark::State y;
};

/// From near to infinity and past it; initialized at the camera's pose, and beside it.
std::vector<Case> cases() {
  RandomStream random(1, "stereo inverse depths");
  std::vector<Case> all;
  for (const double rho : {5.0, 0.5, 1e-3, 1e-12, 0.0, -0.02})
    for (const Vector2d& ray : {Vector2d(0, 0), Vector2d(0.4, -0.3), Vector2d(-0.6, 0.5)})
      for (const double beside : {0.0, 0.05}) {
        Case one{some_camera(random), {}, {}};
        one.form.world_from_initial_camera = one.x.segment<4>(3);
        one.y << to_world(one.x, beside * Vector3d(1, -2, 0.5)), ray, rho;
        const Vector3d turn = beside * Vector3d(1, 2, -3);
        one.x.segment<4>(3) = quaternion_product<double>(one.x.segment<4>(3), quaternion_exp<double>(turn));
        all.push_back(one);
      }
  return all;
}

/// Stereo measurement by definition: two lenses in one body. A direction vector along the landmark is scaled
/// so that its inverse depth refers to it, and the baseline by the inverse depth.
template <class S, class Model>
Vector3<S> seen(const Model& model, const InverseDepthLandmark& form, const FreeCameraMotion::State<S>& left,
                const Eigen::Matrix<S, 6, 1>& y) {
  const Vector3<S> c = form.in_camera<S>(left, y);
  const Vector2<S> by_left = model.template h<S>(c);
  const Vector2<S> by_right = model.template h<S>(Vector3<S>(c - y[5] * Vector3<S>(S(baseline), S(0), S(0))));
  return {by_left[0], by_left[1], by_right[0]};
}

template <class Model>
void check_prediction(const Model& model) {
  const StereoCamera stereo{Camera(model), baseline};
  int tried = 0;
  for (const Case& c : cases()) {
    const auto prediction = stereo.predict_measurement(c.x, c.form, c.y);
    if (!prediction) continue;
    ++tried;
    constexpr int n = camera_errors + 6;
    const auto e = variables<n>(Eigen::Matrix<double, camera_errors, 1>::Zero().eval());
    const auto z = seen<Dual<n>>(model, c.form, moved<Dual<n>>(c.x, e), variables<n>(c.y, camera_errors));
    const auto J = derivatives<n, 3>(z);
    expect_near(prediction->z, (values<n, 3>(z)), 1e-10);
    expect_near(prediction->Hv, J.template leftCols<camera_errors>(), 1e-10);
    expect_near(prediction->Hl, J.template rightCols<6>(), 1e-10);
  }
  EXPECT_GE(tried, 20);
}

TEST(StereoInverseDepthMeasurement, JacobiansAreExact) {
  check_prediction(wide);
  check_prediction(WideAngleCamera{});
  check_prediction(pinhole);
}

TEST(StereoInverseDepthMeasurement, EqualsThatOfTheSamePoint) {
  const StereoCamera stereo{Camera(wide), baseline};
  for (const Case& c : cases()) {
    if (!(c.y[5] > 0.1)) continue;
    const auto by_inverse_depth = stereo.predict_measurement(c.x, c.form, c.y);
    const auto point = stereo.predict_measurement(c.x, c.form.point(c.y).position);
    ASSERT_TRUE(by_inverse_depth && point);
    expect_near(by_inverse_depth->z, point->z, 1e-10);
    expect_near(by_inverse_depth->right, point->right, 1e-10);
    expect_near(by_inverse_depth->Hv, point->Hv, 1e-10);
    expect_near(by_inverse_depth->Hl, point->Hl * c.form.point(c.y).J, 1e-9);
  }
}

TEST(StereoInverseDepthMeasurement, HasZeroDisparityAtInfinity) {
  const StereoCamera stereo{Camera(pinhole), baseline};
  for (const Case& c : cases()) {
    if (c.y[5] != 0) continue;
    const auto prediction = stereo.predict_measurement(c.x, c.form, c.y);
    ASSERT_TRUE(prediction);
    EXPECT_EQ(prediction->z[0], prediction->z[2]);
    EXPECT_EQ(prediction->Hv.leftCols<3>().norm(), 0);
  }
}

std::vector<Vector3d> where_both_see() {
  std::vector<Vector3d> all;
  for (const double depth : {0.3, 1.0, 5.0, 25.0})
    for (const Vector2d& ray : {Vector2d(0, 0), Vector2d(0.5, 0.3), Vector2d(-0.4, -0.5)})
      all.push_back(depth * Vector3d(ray.x(), ray.y(), 1));
  return all;
}

TEST(StereoInverseDepthInitialization, IsTheInverseOfTheMeasurement) {
  RandomStream random(2, "stereo births");
  for (const Camera& camera : {Camera(wide), Camera(WideAngleCamera{}), Camera(pinhole)})
    for (const Vector3d& c : where_both_see()) {
      const StereoCamera stereo{camera, baseline};
      const CameraState x = some_camera(random);
      const auto prediction = stereo.predict_measurement(x, to_world(x, c));
      const auto initialized = stereo.initialize_inverse_depth(x, prediction->z);
      ASSERT_TRUE(initialized) << c.transpose();
      EXPECT_LE((initialized->form.point(initialized->landmark).position - to_world(x, c)).norm(),
                1e-9 * c.squaredNorm());
      const auto again = stereo.predict_measurement(x, initialized->form, initialized->landmark);
      ASSERT_TRUE(again);
      expect_near(again->z, prediction->z, 1e-10);
      EXPECT_LE((again->Hl * initialized->Jz - Eigen::Matrix3d::Identity()).norm(), 1e-9);
      const StereoCamera::Jacobian stays = again->Hv + again->Hl * initialized->Jv;
      EXPECT_LE(stays.norm(), 1e-9 * again->Hv.norm());
    }
}

/// Against triangulation for lenses without distortion, written with dual numbers. The axes of the
/// initialization are constant: measurements of a displaced camera are rotated into them.
TEST(StereoInverseDepthInitialization, JacobiansAreThoseOfTriangulation) {
  constexpr int n = camera_errors + 3;
  using D = Dual<n>;
  const WideAngleCamera lens{};
  const StereoCamera stereo{Camera(lens), baseline};
  RandomStream random(3, "triangulation");
  for (const Vector3d& c : where_both_see()) {
    const CameraState x = some_camera(random);
    const auto prediction = stereo.predict_measurement(x, to_world(x, c));
    const auto initialized = stereo.initialize_inverse_depth(x, prediction->z);
    ASSERT_TRUE(initialized);
    const auto z = variables<n>(prediction->z, camera_errors);
    const auto camera = moved<D>(x, variables<n>(Eigen::Matrix<double, camera_errors, 1>::Zero().eval()));
    const D inverse = (z[0] - z[2]) / D(lens.fu * baseline);
    const Vector3<D> ray((z[0] - D(lens.u0)) / D(lens.fu), (z[1] - D(lens.v0)) / D(lens.fv), D(1));
    const Vector3<D> in_world = rotation_matrix<D>(camera.template segment<4>(3)) * ray;
    const Vector3<D> in_initial_camera =
        rotation_matrix<D>(initialized->form.world_from_initial_camera.cast<D>()).transpose() * in_world;
    Eigen::Matrix<D, 6, 1> y;
    y << camera.template head<3>(), in_initial_camera[0] / in_initial_camera[2],
        in_initial_camera[1] / in_initial_camera[2], inverse / in_initial_camera[2];
    const auto J = derivatives<n, 6>(y);
    expect_near(initialized->landmark, (values<n, 6>(y)), 1e-9);
    expect_near(initialized->Jv, J.template leftCols<camera_errors>(), 1e-9);
    expect_near(initialized->Jz, J.template rightCols<3>(), 1e-9);
  }
}

TEST(StereoInverseDepthInitialization, FailsWithoutEnoughDisparity) {
  const CameraState x = (CameraState() << 0, 0, 0, 1, Eigen::Matrix<double, 9, 1>::Zero()).finished();
  const StereoCamera stereo{Camera(wide), baseline, 0.5};
  EXPECT_TRUE(stereo.initialize_inverse_depth(x, {160, 120, 159}));
  for (const double u_right : {159.5, 160.0, 170.0, double(NAN)})
    EXPECT_FALSE(stereo.initialize_inverse_depth(x, {160, 120, u_right})) << u_right;
  EXPECT_FALSE(stereo.initialize_inverse_depth(x, {NAN, 120, 150}));
}

}  // namespace
}  // namespace incognita
