// Properties of every camera model. A new model is added by one line in the list below.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "incognita/math/random.hpp"
#include "incognita/models/sensors/camera.hpp"
#include "incognita/models/sensors/fisheye_camera.hpp"
#include "incognita/models/sensors/pinhole_camera.hpp"
#include "incognita/models/sensors/wide_angle_camera.hpp"
#include "tests/models/dual.hpp"

namespace incognita {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

template <auto camera>
struct Example {
  static constexpr auto model = camera;
};

using Cameras = ::testing::Types<           //
    Example<WideAngleCamera{}>,             //
    Example<WideAngleCamera{.kd1 = 9e-6}>,  // field of view 100 degrees
    Example<WideAngleCamera{
        .width = 640, .height = 480, .fu = 400, .fv = 420, .u0 = 300, .v0 = 250, .kd1 = 1e-6}>,
    Example<PinholeCamera{}>,                                                 //
    Example<PinholeCamera{.k1 = -0.28, .k2 = 0.07, .p1 = 2e-4, .p2 = 2e-5}>,  // a lens of EuRoC
    // a lens of TUM RGB-D
    Example<PinholeCamera{.k1 = 0.26, .k2 = -0.95, .p1 = -5e-3, .p2 = 3e-3, .k3 = 1.16}>,
    Example<FisheyeCamera{.fu = 129, .fv = 129}>,  // equidistant, corners at 88.5 degrees
    // a lens of TUM VI, of which the image ends before 90 degrees here
    Example<FisheyeCamera{.width = 400,
                          .height = 400,
                          .fu = 191,
                          .fv = 190.9,
                          .u0 = 199.9,
                          .v0 = 200.9,
                          .k1 = 0.0034824,
                          .k2 = 0.0007151,
                          .k3 = -0.0020532,
                          .k4 = 0.0002029}>>;

template <class E>
class CameraLaws : public ::testing::Test {
 protected:
  static constexpr auto model = E::model;
  using Model = std::remove_const_t<decltype(model)>;

  /// Pixels all over the image, including its edges and corners.
  static std::vector<Vector2d> pixels() {
    std::vector<Vector2d> all;
    constexpr int across = 16, down = 12;
    for (int i = 0; i <= across; ++i)
      for (int k = 0; k <= down; ++k)
        all.emplace_back((model.width - 1.0) * i / across, (model.height - 1.0) * k / down);
    return all;
  }

  /// Points in camera axes that must be in view, at many depths.
  static std::vector<Vector3d> points_in_view() {
    std::vector<Vector3d> all;
    RandomStream random(1, "depths");
    for (const Vector2d& pixel : pixels())
      if (const auto ray = model.unproject(pixel))
        all.push_back(*ray * std::pow(10.0, random.uniform(-2, 3)));
    return all;
  }

  /// Ill-conditioned points: on the axis, close to it, far off it, nearly behind, very near, very far.
  static std::vector<Vector3d> nasty_points() {
    return {{0, 0, 1},          {0, 0, 1e6},     {1e-12, 0, 1},  {0, -1e-9, 2},  {1e-7, 1e-7, 1e-3},
            {0.3, 0, 1},        {0, 0.3, 1},     {10, 3, 0.1},   {-8, 20, 1e-2}, {1, -1, 1e-4},
            {1e-3, 1e-3, 1e-6}, {1e-8, 0, 1e-8}, {1e5, 2e5, 1e6}};
  }

  static void expect_exact_jacobian(const Vector3d& point) {
    const Vector2<Dual<3>> exact = model.template h<Dual<3>>(variables<3>(point));
    const Projection projection = model.project(point);
    const Vector2d plain = model.template h<double>(point);
    const Eigen::Matrix<double, 2, 3> J = derivatives<3, 2>(exact);
    EXPECT_LE((projection.J - J).norm(), 1e-11 * J.norm()) << "at " << point.transpose() << "\ncoded\n"
                                                           << projection.J << "\nexact\n"
                                                           << J;
    EXPECT_LE((projection.pixel - plain).norm(), 1e-13 * (1 + plain.norm())) << "project() differs from h()";
    EXPECT_LE((J * point).norm(), 1e-12 * J.norm() * point.norm())
        << "the distance along the ray is unobservable";
  }
};

TYPED_TEST_SUITE(CameraLaws, Cameras);

TYPED_TEST(CameraLaws, EveryPixelHasARay) {
  for (const Vector2d& pixel : this->pixels()) EXPECT_TRUE(this->model.unproject(pixel)) << pixel.transpose();
  EXPECT_EQ(this->points_in_view().size(), this->pixels().size());
}

TYPED_TEST(CameraLaws, JacobianIsExactAllOverTheImage) {
  for (const Vector3d& point : this->points_in_view()) {
    ASSERT_TRUE(this->model.defined(point)) << point.transpose();
    this->expect_exact_jacobian(point);
  }
}

TYPED_TEST(CameraLaws, JacobianIsExactAtNastyPoints) {
  int tried = 0;
  for (const Vector3d& point : this->nasty_points()) {
    // far off the axis, where the polynomial is no longer monotonic
    if (!this->model.defined(point)) continue;
    ++tried;
    this->expect_exact_jacobian(point);
  }
  EXPECT_GE(tried, 8);
}

TYPED_TEST(CameraLaws, UnprojectIsTheInverseOfProject) {
  for (const Vector3d& point : this->points_in_view()) {
    const auto ray = this->model.unproject(this->model.project(point).pixel);
    ASSERT_TRUE(ray) << point.transpose();
    EXPECT_EQ(ray->z(), 1);
    EXPECT_LE((*ray - point / point.z()).norm(), 1e-10 * ray->norm()) << point.transpose();
  }
}

TYPED_TEST(CameraLaws, ProjectIsTheInverseOfUnproject) {
  for (const Vector2d& pixel : this->pixels()) {
    const auto ray = this->model.unproject(pixel);
    ASSERT_TRUE(ray) << pixel.transpose();
    EXPECT_LE((this->model.project(*ray).pixel - pixel).norm(), 1e-9) << pixel.transpose();
  }
}

TYPED_TEST(CameraLaws, RightAndDownArePositive) {
  const Vector2d center = this->model.project(Vector3d(0, 0, 1)).pixel;
  EXPECT_LE((center - Vector2d(this->model.u0, this->model.v0)).norm(), 1e-12);
  EXPECT_GT(this->model.project(Vector3d(0.1, 0, 1)).pixel.x(), center.x() + 1);
  EXPECT_GT(this->model.project(Vector3d(0, 0.1, 1)).pixel.y(), center.y() + 1);
}

TYPED_TEST(CameraLaws, BehindTheCameraIsRefused) {
  const Camera camera(this->model);
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Vector3d& point : {Vector3d(0, 0, -1), Vector3d(0.1, 0.2, -1e-12), Vector3d(0, 0, 0),
                                Vector3d(1, 1, 0), Vector3d(-1, 2, -5), Vector3d(0, 0, nan)}) {
    EXPECT_FALSE(this->model.defined(point)) << point.transpose();
    EXPECT_FALSE(camera.project(point)) << point.transpose();
  }
}

TYPED_TEST(CameraLaws, TheVariantEqualsItsModel) {
  const Camera camera(this->model);
  EXPECT_EQ(camera.width(), this->model.width);
  EXPECT_EQ(camera.height(), this->model.height);
  for (const Vector3d& point : this->points_in_view()) {
    const auto projection = camera.project(point);
    ASSERT_TRUE(projection);
    EXPECT_EQ(projection->pixel, this->model.project(point).pixel);
    EXPECT_EQ(projection->J, this->model.project(point).J);
    EXPECT_TRUE(camera.contains(projection->pixel, -1e-6));
  }
  EXPECT_TRUE(camera.contains({0, 0}));
  EXPECT_TRUE(camera.contains({camera.width() - 1.0, camera.height() - 1.0}));
  EXPECT_FALSE(camera.contains({camera.width() - 0.5, 10}));
  EXPECT_FALSE(camera.contains({10, -0.1}));
  EXPECT_FALSE(camera.contains({4, 100}, 5));
  EXPECT_TRUE(camera.contains({5, 100}, 5));
}

/// Each kind of invalid parameter is refused with the parameter's name, by the model and by the variant.
template <class Model, class T>
void expect_refused(const Model& good, T Model::*parameter, const std::string& parameter_name,
                    std::initializer_list<double> values) {
  for (const double value : values) {
    Model bad = good;
    bad.*parameter = static_cast<T>(value);
    try {
      bad.check();
      ADD_FAILURE() << parameter_name << " = " << value << " was accepted";
    } catch (const std::invalid_argument& refusal) {
      EXPECT_NE(std::string(refusal.what()).find(parameter_name), std::string::npos) << refusal.what();
    }
    EXPECT_THROW(Camera{bad}, std::invalid_argument) << parameter_name;
  }
}

TYPED_TEST(CameraLaws, InvalidParametersAreRefusedByName) {
  using C = typename TestFixture::Model;
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(),
                   inf = std::numeric_limits<double>::infinity();
  const C good = this->model;
  EXPECT_NO_THROW(good.check());
  expect_refused(good, &C::width, "width_px", {-1, 0, 15});
  expect_refused(good, &C::height, "height_px", {-1, 0, 15});
  expect_refused(good, &C::fu, "fu_px", {0, -195, nan, inf});
  expect_refused(good, &C::fv, "fv_px", {0, -195, nan, inf});
  expect_refused(good, &C::u0, "u0_px", {-1, 0, 1.0 * good.width, 1e9, nan, inf});
  expect_refused(good, &C::v0, "v0_px", {-1, 0, 1.0 * good.height, 1e9, nan, inf});
  if constexpr (requires { &C::kd1; }) expect_refused(good, &C::kd1, "kd1", {-1e-9, nan, inf});
  if constexpr (requires { &C::k1; }) expect_refused(good, &C::k1, "k1", {nan, inf});
  if constexpr (requires { &C::k2; }) expect_refused(good, &C::k2, "k2", {nan, inf});
  if constexpr (requires { &C::k3; }) expect_refused(good, &C::k3, "k3", {nan, inf});
  if constexpr (requires { &C::k4; }) expect_refused(good, &C::k4, "k4", {nan, inf});
  if constexpr (requires { &C::p1; }) expect_refused(good, &C::p1, "p1", {nan, inf});
  if constexpr (requires { &C::p2; }) expect_refused(good, &C::p2, "p2", {nan, inf});
}

}  // namespace

TEST(WideAngleCamera, EqualsThesisEquation526) {
  const WideAngleCamera camera{.fu = 200, .fv = 210, .u0 = 160, .v0 = 120, .kd1 = 9e-6};
  // u_c = 100, v_c = -42, d = 1 + 1.8e-5 (10000 + 1764) = 1.211752
  const Vector2d pixel = camera.h<double>(Vector3d(1, -0.4, 2));
  EXPECT_NEAR(pixel.x(), 160 + 100 / std::sqrt(1.211752), 1e-12);
  EXPECT_NEAR(pixel.y(), 120 - 42 / std::sqrt(1.211752), 1e-12);
}

TEST(WideAngleCamera, HasNoRayBeyondTheImageOfInfinity) {
  const WideAngleCamera camera{.kd1 = 9e-6};
  const double edge = 1 / std::sqrt(2 * camera.kd1);  // 235.7 px from the principal point
  EXPECT_TRUE(camera.unproject({camera.u0 + edge - 0.01, camera.v0}));
  EXPECT_FALSE(camera.unproject({camera.u0 + edge + 0.01, camera.v0}));
}

}  // namespace incognita
