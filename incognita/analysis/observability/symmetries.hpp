// Symmetries of the measurements: joint motions of vehicle and map that leave all measurements unchanged.
//
// Range and bearing on a plane are invariant under two translations and a rotation; a freely moving camera is
// invariant under three translations, three rotations, and a change of scale. A symmetry remains if it leaves
// every known point in place; the others vanish with the first measurements of the points they would move.
//
// A symmetry about a center c is given by its generator coordinates: translation (m), rotation about c (rad;
// one on a plane, in space about the world's axes), and in space the relative change of all distances from c.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "incognita/models/motion/planar_vehicle.hpp"
#include "incognita/models/sensors/camera_measurement.hpp"

namespace incognita {

/// Planar vehicles with range-bearing sensors: the errors of their poses in order, then those of the landmarks.
struct PlanarScene {
  static constexpr int dimension = 2;
  static constexpr int generators = 3;

  struct Landmark {
    std::int64_t id = 0;
    int first = 0;  ///< index of its first error
    Eigen::Vector2d position{0, 0};
  };
  std::vector<planar::Pose<double>> vehicles{{0, 0, 0}};
  std::vector<Landmark> landmarks;
  int errors = 3;

  /// Of the first vehicle.
  Eigen::Vector2d position() const { return vehicles.front().head<2>(); }
};

/// A free camera (FreeCameraMotion's 12 errors) among landmarks.
struct SpatialScene {
  static constexpr int dimension = 3;
  static constexpr int generators = 7;

  struct Landmark {
    enum class Form {
      point,
      inverse_depth,
      ray,  ///< an inverse-depth landmark without depth in the state
    };
    std::int64_t id = 0;
    int first = 0;  ///< index of its first error
    Form form = Form::point;
    InverseDepthLandmark initial_axes{};
    /// As many numbers as it has errors.
    InverseDepthLandmark::State mean = InverseDepthLandmark::State::Zero();
  };
  CameraState camera = CameraState::Zero();
  std::vector<Landmark> landmarks;
  int errors = FreeCameraMotion::error_size;

  Eigen::Vector3d position() const { return free_camera::position(camera); }
};

/// Position of a landmark, and d(position) / d(errors); empty if its depth is unknown or not positive.
struct LandmarkPoint {
  Eigen::Vector3d position;
  Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 6> J;
};
std::optional<LandmarkPoint> landmark_point(const SpatialScene::Landmark& landmark);

/// Errors x generators: derivative of the scene's errors with respect to each generator about c.
Eigen::MatrixXd symmetry_directions(const PlanarScene& scene, const Eigen::Vector2d& c);
Eigen::MatrixXd symmetry_directions(const SpatialScene& scene, const Eigen::Vector3d& c);

/// Dimension x generators: derivative of a point's position with respect to each generator about c.
Eigen::MatrixXd displacement(const Eigen::VectorXd& point, const Eigen::VectorXd& c);

/// The symmetries that leave given points in place.
struct RemainingSymmetries {
  Eigen::VectorXd about;  ///< c: centroid of the points, the origin without points
  Eigen::MatrixXd basis;  ///< generators x number of remaining symmetries
};
/// `points`: dimension x number. Points within a thousandth of their spread from a common line, or from one
/// position, are treated as collinear or coincident.
RemainingSymmetries remaining_symmetries(const Eigen::MatrixXd& points);

/// Length scale of the scene: median distance of its landmarks from the vehicle; 1 without landmarks.
double typical_distance(const PlanarScene& scene);
double typical_distance(const SpatialScene& scene);

/// Per error, the standard deviation that counts as no information: the typical distance, a radian etc.
Eigen::VectorXd units_of(const PlanarScene& scene);
Eigen::VectorXd units_of(const SpatialScene& scene);

}  // namespace incognita
