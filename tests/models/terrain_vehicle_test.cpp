// A vehicle on uneven ground against the contact condition, against the planar vehicle, and against (6.10) as
// printed.
#include "incognita/models/motion/terrain_vehicle.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <vector>

#include "incognita/math/random.hpp"
#include "incognita/models/motion/mount.hpp"
#include "tests/models/dual.hpp"
#include "tests/models/grounds.hpp"

namespace incognita {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::Vector4d;

std::vector<TerrainVehicle> vehicles() {
  return {TerrainVehicle{}, TerrainVehicle{grounds::steep_slope()}, TerrainVehicle{grounds::gentle_waves()},
          TerrainVehicle{grounds::steep_waves()}, TerrainVehicle{grounds::small_height_map()}};
}

std::vector<Vector3d> terrain_states() {
  std::vector<Vector3d> all{
      {0, 0, 0}, {1, -2, std::numbers::pi}, {-9, 15, -std::numbers::pi / 2}, {30, -40, 2}};
  RandomStream random(1, "states");
  for (int i = 0; i < 20; ++i)
    all.push_back(Vector3d(random.uniform(-8, 8), random.uniform(-14, 14), random.uniform(-3.14, 3.14)));
  return all;
}

std::vector<Vector2d> inputs() { return {{0, 0}, {1.5, 0}, {0, 0.7}, {-0.8, 1.1}, {2, -2}}; }

/// The continuous motion, by many small fourth-order steps.
Vector3d driven(const TerrainVehicle& vehicle, Vector3d x, const Vector2d& u, double seconds, int steps) {
  const double h = seconds / steps;
  const auto rate = [&](const Vector3d& at) { return vehicle.rate<double>(at, u); };
  for (int i = 0; i < steps; ++i) {
    const Vector3d a = rate(x), b = rate(x + h / 2 * a), c = rate(x + h / 2 * b), d = rate(x + h * c);
    x += h / 6 * (a + 2 * b + 2 * c + d);
  }
  return x;
}

TEST(TerrainVehicle, AxesAreOrthonormalAndTangentToTheGround) {
  for (const auto& vehicle : vehicles())
    for (const Vector3d& x : terrain_states()) {
      const Matrix3d R = vehicle.axes<double>(x);
      EXPECT_LE((R.transpose() * R - Matrix3d::Identity()).norm(), 1e-14);
      EXPECT_NEAR(R.determinant(), 1, 1e-14);
      EXPECT_LE((rotation_matrix(vehicle.pose(x).pose.world_from_body) - R).norm(), 1e-14);
      EXPECT_LE(wrap_angle(std::atan2(R(1, 0), R(0, 0)) - x[2]), 1e-14)
          << "the heading is that of the forward axis in the plane";
      // The normal, from differences of height alone
      const double e = 1e-5, up = 1 / (2 * e);
      const auto height = [&](double dx, double dy) {
        return vehicle.position<double>(x + Vector3d(dx, dy, 0)).z();
      };
      const Vector3d normal =
          Vector3d((height(-e, 0) - height(e, 0)) * up, (height(0, -e) - height(0, e)) * up, 1).normalized();
      EXPECT_LE((R.col(2) - normal).norm(), 1e-8) << x.transpose();
    }
}

/// From positions and orientations along the integrated motion alone: no formula of the model's rate is used.
TEST(TerrainVehicle, SpeedIsAlongTheGroundAndTurnRateAboutTheNormal) {
  const double e = 1e-4;
  for (const auto& vehicle : vehicles())
    for (const Vector3d& start : terrain_states())
      for (const Vector2d& u : inputs()) {
        const Vector3d before = driven(vehicle, start, u, 1 - e, 400);
        const Vector3d now = driven(vehicle, before, u, e, 1), after = driven(vehicle, now, u, e, 1);
        const Matrix3d R = vehicle.axes<double>(now);
        const Vector3d velocity =
            (vehicle.position<double>(after) - vehicle.position<double>(before)) / (2 * e);
        EXPECT_LE((velocity - u[0] * R.col(0)).norm(), 5e-6) << "along its forward axis, on the ground";
        EXPECT_NEAR(velocity.norm(), std::abs(u[0]), 5e-6);
        const Vector4d turn = quaternion_product<double>(
            quaternion_conjugate<double>(vehicle.pose(before).pose.world_from_body),
            vehicle.pose(after).pose.world_from_body);
        const Vector3d body_rate = quaternion_log<double>(turn) / (2 * e);
        EXPECT_NEAR(body_rate.z(), u[1], 5e-6) << start.transpose() << " u " << u.transpose();
      }
}

TEST(TerrainVehicle, PoseJacobianTimesRateIsTheVelocity) {
  for (const auto& vehicle : vehicles())
    for (const Vector3d& x : terrain_states())
      for (const Vector2d& u : inputs()) {
        const Eigen::Matrix<double, 6, 1> v = vehicle.pose(x).J * vehicle.rate<double>(x, u);
        EXPECT_LE((v.head<3>() - u[0] * vehicle.axes<double>(x).col(0)).norm(), 1e-13);
        EXPECT_NEAR(v[5], u[1], 1e-13);
      }
}

TEST(TerrainVehicle, PoseJacobianIsExact) {
  using D = Dual<3>;
  for (const auto& vehicle : vehicles())
    for (const Vector3d& x : terrain_states()) {
      const auto moved = variables<3>(x);
      const Matrix3<D> axes = vehicle.axes<D>(moved);
      const auto pose = vehicle.pose(x);
      const Matrix3d R = rotation_matrix(pose.pose.world_from_body);
      Eigen::Matrix<double, 6, 3> J;
      J.topRows<3>() = derivatives<3, 3>(vehicle.position<D>(moved));
      for (int i = 0; i < 3; ++i) {  // R exp(e): R' dR is the cross-product matrix of e
        Matrix3d dR;
        for (int k = 0; k < 9; ++k) dR(k) = axes(k).derivatives()[i];
        const Matrix3d cross = R.transpose() * dR;
        EXPECT_LE((cross + cross.transpose()).norm(), 1e-12);
        J.bottomRows<3>().col(i) << cross(2, 1), cross(0, 2), cross(1, 0);
      }
      EXPECT_LE((pose.J - J).norm(), 1e-12 * J.norm()) << x.transpose();
    }
}

TEST(TerrainVehicle, JacobiansAreExactOnSteepGround) {
  const TerrainVehicle vehicle{grounds::steep_waves()};
  for (const Vector3d& x : terrain_states())
    for (const Vector2d& u : inputs()) {
      const auto y = vehicle.f<Dual<5>>(variables<5>(x), variables<5>(u, 3), 0.1);
      const auto J = derivatives<5, 3>(y);
      const auto step = vehicle.step(x, u, 0.1);
      EXPECT_LE((step.F - J.leftCols<3>()).norm(), 1e-12 * J.norm());
      EXPECT_LE((step.G - J.rightCols<2>()).norm(), 1e-12 * J.norm());
    }
}

TEST(TerrainVehicle, EqualsTheDifferentialDriveOnLevelGround) {
  const TerrainVehicle vehicle{TiltedPlane{.height_m = 3}};
  for (const Vector3d& x : terrain_states())
    for (const Vector2d& u : inputs()) {
      EXPECT_EQ(vehicle.rate<double>(x, u), DifferentialDrive{}.rate<double>(x, u));
      const auto pose = vehicle.pose(x), floor = on_floor(x);
      EXPECT_LE((pose.pose.position - floor.pose.position - Vector3d(0, 0, 3)).norm(), 0);
      EXPECT_LE(
          (rotation_matrix(pose.pose.world_from_body) - rotation_matrix(floor.pose.world_from_body)).norm(),
          1e-15);
      EXPECT_LE((pose.J - floor.J).norm(), 1e-15);
    }
}

TEST(TerrainVehicle, AStepIsOfFourthOrder) {
  for (const auto& ground : {grounds::gentle_waves(), grounds::steep_slope()}) {
    const TerrainVehicle vehicle{ground};
    const Vector3d start(1, 2, 0.4);
    const Vector2d u(1.2, 0.9);
    const auto missed = [&](int steps) {
      Vector3d x = start;
      for (int i = 0; i < steps; ++i) x = vehicle.f<double>(x, u, 2.0 / steps);
      return (x - driven(vehicle, start, u, 2, 4000)).norm();
    };
    EXPECT_NEAR(std::log2(missed(10) / missed(20)), 4, 0.3);
    EXPECT_LT(missed(60), 1e-7) << "two seconds of frames";
  }
}

TEST(TerrainVehicle, ALongStepFollowsTheGroundInBetween) {
  for (const auto& vehicle : vehicles())
    for (const Vector2d& u : {Vector2d(6, 0), Vector2d(0, 9), Vector2d(-4, 5)}) {
      const Vector3d start(1, 2, 0.4), after = vehicle.f<double>(start, u, 1);
      Vector3d exact = driven(vehicle, start, u, 1, 20000);
      exact[2] = wrap_angle(exact[2]);
      EXPECT_GE(vehicle.pieces<double>(u, 1), 20);
      // On a slope of 73 degrees the heading in the horizontal plane changes up to 3.4 times as fast as the
      // body rotates
      EXPECT_LT((after - exact).norm(), 0.03) << "u " << u.transpose();
    }
  EXPECT_EQ(TerrainVehicle{}.pieces<double>({1, 1}, 1.0 / 30), 1);
  EXPECT_EQ(TerrainVehicle{}.pieces<double>({INFINITY, NAN}, 1), TerrainVehicle::most_pieces);
}

// ---- (6.10) as printed ----

struct Printed {
  Vector3d velocity;  ///< of the optical center
  Vector3d angles;    ///< rates of psi, theta, phi
};

/// Gamma u. `lever_as_printed` leaves cos(psi) in the second column of the first three rows.
Printed gamma(const Vector3d& angles, double l, const Vector2d& u, bool lever_as_printed) {
  const double psi = angles[0], theta = angles[1], phi = angles[2];
  const double lever = lever_as_printed ? l * std::cos(psi) : l;
  const Vector3d ahead(-std::sin(phi) * std::sin(psi) - std::cos(phi) * std::cos(psi) * std::sin(theta),
                       std::cos(phi) * std::sin(psi) - std::sin(phi) * std::cos(psi) * std::sin(theta),
                       std::cos(psi) * std::cos(theta));
  const Vector3d aside(-std::cos(theta) * std::cos(phi), -std::cos(theta) * std::sin(phi), -std::sin(theta));
  return {u[0] * ahead + u[1] * lever * aside,
          u[1] * Vector3d(std::sin(psi) * std::tan(theta), std::cos(psi), std::sin(psi) / std::cos(theta))};
}

/// psi, theta, phi such that R = Rz(phi) Ry(-theta) Rx(-psi).
Vector3d thesis_angles(const Matrix3d& R) {
  return {-std::atan2(R(2, 1), R(2, 2)), std::asin(R(2, 0)), std::atan2(R(1, 0), R(0, 0))};
}

struct Camera610 {
  Vector3d velocity, angles, angle_rates;
};

/// Velocities by the contact condition of a camera mounted l ahead of the axle and facing forward, expressed
/// in a world rotated by `thesis_from_ours`.
Camera610 by_contact(const TerrainVehicle& vehicle, const Vector3d& x, const Vector2d& u, double l,
                     const Matrix3d& thesis_from_ours) {
  const Mount mount{.forward_m = l};
  const auto camera = [&](double seconds) {
    return mount.on(vehicle.pose(driven(vehicle, x, u, seconds, 1))).camera;
  };
  const auto angles = [&](double seconds) -> Vector3d {
    return thesis_angles(thesis_from_ours * rotation_matrix<double>(camera(seconds).segment<4>(3)));
  };
  const double e = 1e-5;
  return {thesis_from_ours * (camera(e).head<3>() - camera(-e).head<3>()) / (2 * e), angles(0),
          (angles(e) - angles(-e)) / (2 * e)};
}

Matrix3d y_up() {  // the thesis' world: x right, y up, so that z points towards the viewer
  return (Matrix3d() << 1, 0, 0, 0, 0, 1, 0, -1, 0).finished();
}

TEST(Printed610, IsCorrectOnAnyPlaneWithARigidLever) {
  const double l = 0.3;
  for (const Matrix3d& world : {Matrix3d(Matrix3d::Identity()), y_up()})
    for (const TiltedPlane& plane :
         {TiltedPlane{.slope_x = 0.3, .slope_y = -0.2}, TiltedPlane{.slope_y = 1.5}})
      for (const double heading : {0.3, -1.2, 2.0})
        for (const Vector2d& u : inputs()) {
          const auto exact = by_contact({plane}, {1, 2, heading}, u, l, world);
          const Printed rigid = gamma(exact.angles, l, u, false), printed = gamma(exact.angles, l, u, true);
          EXPECT_LE((exact.velocity - rigid.velocity).norm(), 1e-8);
          EXPECT_LE((exact.angle_rates - rigid.angles).norm(), 1e-7);
          const double short_of = l * std::abs(u[1]) * (1 - std::cos(exact.angles[0]));
          EXPECT_NEAR((exact.velocity - printed.velocity).norm(), short_of, 1e-8);
        }
}

TEST(Printed610, HasNoLeverWhereZIsUp) {
  const Vector2d u(0, 1);
  const auto level = by_contact({}, {0, 0, 0.3}, u, 0.3, Matrix3d::Identity());
  EXPECT_NEAR(level.velocity.norm(), 0.3, 1e-8);
  EXPECT_NEAR(gamma(level.angles, 0.3, u, true).velocity.norm(), 0, 1e-8);
}

TEST(Printed610, LeavesCurvedGround) {
  const TerrainVehicle vehicle{grounds::gentle_waves()};
  const Vector3d x(1, 2, 0.3);
  const auto exact = by_contact(vehicle, x, {1, 0}, 0, y_up());
  const Printed printed = gamma(exact.angles, 0, {1, 0}, true);
  EXPECT_LE((exact.velocity - printed.velocity).norm(), 1e-8);
  EXPECT_EQ(printed.angles.norm(), 0) << "it drives straight without pitch or roll";
  EXPECT_GT(exact.angle_rates.norm(), 0.02);
  // and so leaves the ground quadratically in the distance: straight along the tangent
  const Vector3d forward = vehicle.axes<double>(x).col(0);
  const auto off = [&](double way) {
    const Vector3d p = vehicle.position<double>(x) + way * forward;
    return std::abs(p.z() - vehicle.terrain.at<double>(p.x(), p.y()).height);
  };
  EXPECT_GT(off(1), 0.005);
  EXPECT_NEAR(off(0.02) / off(0.01), 4, 0.1);
  // while the model stays on it for any step
  const Vector3d after = vehicle.f<double>(x, {1, 0}, 1);
  EXPECT_EQ(vehicle.position<double>(after).z(), vehicle.terrain.at<double>(after.x(), after.y()).height);
}

}  // namespace
}  // namespace incognita
