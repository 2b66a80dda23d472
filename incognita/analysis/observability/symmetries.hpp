// What no looks can tell: the motions of vehicle and map together that change nothing a sensor sees.
//
// Range and bearing on a plane see the same from anywhere: two translations and a turn. A camera moving
// freely sees no lengths either: three translations, three turns, and the scale. A symmetry that leaves every
// known point where it is stays one; the others are gone with the first looks at what they would move.
//
// A symmetry is told about a place c by its generator coordinates: translation (m), turn about c (rad; on a
// plane one, in space about the world's axes), and in space the relative change of all distances from c.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "incognita/models/camera_measurement.hpp"
#include "incognita/models/planar_vehicle.hpp"

namespace incognita {

/// A vehicle with range and bearing on a plane: error of the pose, then whatever landmarks say.
struct PlanarScene {
  static constexpr int dimension = 2;
  static constexpr int generators = 3;

  struct Landmark {
    std::int64_t id = 0;
    int first = 0;  ///< error
    Eigen::Vector2d position{0, 0};
  };
  planar::Pose<double> vehicle{0, 0, 0};
  std::vector<Landmark> landmarks;
  int errors = 3;

  Eigen::Vector2d position() const { return vehicle.head<2>(); }
};

/// A free camera (FreeCameraMotion's 12 errors) among landmarks.
struct SpatialScene {
  static constexpr int dimension = 3;
  static constexpr int generators = 7;

  struct Landmark {
    enum class Form {
      point,
      inverse_depth,
      ray,  ///< an inverse-depth landmark whose depth is not in the state
    };
    std::int64_t id = 0;
    int first = 0;  ///< error
    Form form = Form::point;
    InverseDepthLandmark initial_axes{};
    InverseDepthLandmark::State mean =
        InverseDepthLandmark::State::Zero();  ///< as many numbers as it has errors
  };
  CameraState camera = CameraState::Zero();
  std::vector<Landmark> landmarks;
  int errors = FreeCameraMotion::error_size;

  Eigen::Vector3d position() const { return free_camera::position(camera); }
};

/// Where a landmark is, and d(position) / d(errors); nothing for one whose depth is not known or not
/// positive.
struct LandmarkPoint {
  Eigen::Vector3d position;
  Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 6> J;
};
std::optional<LandmarkPoint> landmark_point(const SpatialScene::Landmark& landmark);

/// Errors x generators: how the scene's errors change under each generator about c.
Eigen::MatrixXd symmetry_directions(const PlanarScene& scene, const Eigen::Vector2d& c);
Eigen::MatrixXd symmetry_directions(const SpatialScene& scene, const Eigen::Vector3d& c);

/// Dimension x generators: how a point moves under each generator about c.
Eigen::MatrixXd displacement(const Eigen::VectorXd& point, const Eigen::VectorXd& c);

/// The symmetries that leave some points where they are.
struct RemainingSymmetries {
  Eigen::VectorXd about;  ///< c: the points' middle, the origin without points
  Eigen::MatrixXd basis;  ///< generators x how many remain
};
/// `points`: dimension x number. Points that are within a thousandth of their spread from one line, or from
/// one place, are taken to be on it.
RemainingSymmetries remaining_symmetries(const Eigen::MatrixXd& points);

/// A length to measure the scene by: the median distance of its landmarks from the vehicle; 1 without any.
double typical_distance(const PlanarScene& scene);
double typical_distance(const SpatialScene& scene);

/// How much of each error is as good as not knowing it: the typical distance, a radian, and so on.
Eigen::VectorXd units_of(const PlanarScene& scene);
Eigen::VectorXd units_of(const SpatialScene& scene);

}  // namespace incognita
