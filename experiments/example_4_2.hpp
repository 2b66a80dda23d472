// Parts of Example 4.2: the system `inertial`, (4.26) to (4.29), its states and directions.
#pragma once

#include <vector>

#include "experiments/observability_claims.hpp"

namespace incognita::observability_claims::inertial {

/// Nothing accelerates it: the thesis writes f = 0, f being the reading of its accelerometers.
enum class Unaccelerated {
  falls,       ///< f = 0: gravity alone moves it
  weightless,  ///< f = 0 and no gravity: constant velocity
  carried      ///< constant velocity under gravity, not turning: f = -g
};

/// World-centric: position, velocity, angles, and the position of each feature.
inline Case world(int features = 1, int anchors = 0) {
  return {.system = "inertial", .features = features, .anchors = anchors};
}
/// Velocity, angles, and each feature from the vehicle, in axes of the world.
inline Case relative(int features = 1) { return relative_map("inertial", features); }
Case unaccelerated(Case which, Unaccelerated how);

/// `falling 5/2/0 and 1; ...` by the ways to be unaccelerated
std::string by_unaccelerated(const Case& which);

/// Axes of the world into those of the sensor, (4.27), by Euler angles.
Matrix3d C_of(const Vector3d& angles);
/// Rates of Euler angles by turn rates in axes of the sensor, (4.28).
Matrix3d E_of(const Vector3d& angles);
/// [a x]
Matrix3d cross(const Vector3d& a);

using Matrix23 = Eigen::Matrix<double, 2, 3>;
/// Derivative of azimuth and elevation (4.29) by r^s: (4.34) as it must be.
Matrix23 bearings_by(const Vector3d& r_of_sensor);

/// Derivatives of a system by misalignments, which turn about the axes of the world.
struct Misaligned {
  MatrixXd F, H;
};
/// Exact derivatives by Euler angles, the states from `first` on, made into those; the body turns by `rate`,
/// in its own axes.
Misaligned misaligned(const LinearizedSystem& exact, const Vector3d& angles, Eigen::Index first,
                      const Vector3d& rate);

/// What the matrices are made of, where a motion with one feature begins, in the world or relative to the body.
struct Begin {
  Matrix3d C;        ///< (4.27)
  Vector3d r, f;     ///< to the feature, and what accelerometers read, in axes of the world
  Matrix23 A;        ///< dz/dr^s: (4.34) as it must be
  Misaligned exact;  ///< derivatives
  explicit Begin(const Course& course);
};

/// Matrices of so many columns each, side by side.
MatrixXd beside(const std::vector<MatrixXd>& blocks);

std::vector<Claim> matrix_claims();
std::vector<Claim> relative_claims();

}  // namespace incognita::observability_claims::inertial
