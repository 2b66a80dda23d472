// A synthetic scene for tests of the single-camera estimator: one wall with a random texture, seen by a
// pinhole camera without distortion, and helpers to place a camera and landmarks by hand.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "incognita/math/random.hpp"
#include "incognita/messages/observation.hpp"
#include "incognita/messages/tick.hpp"
#include "incognita/models/motion/heading.hpp"
#include "incognita/models/sensors/wide_angle_camera.hpp"
#include "incognita/slam/features/feature.hpp"
#include "incognita/slam/features/landmark_initialization.hpp"

namespace incognita::synthetic {

using CameraCov = FreeCameraMotion::Jacobian;

inline const WideAngleCamera model{};  ///< 320x240, 195 px, no distortion
inline const Camera camera{model};

/// A camera at rest. `heading_rad` from +x to the left, `turn` a rotation vector after it, in camera axes.
inline CameraState camera_at(const Eigen::Vector3d& position, double heading_rad = 0,
                             const Eigen::Vector3d& turn = {0, 0, 0}) {
  CameraState x = CameraState::Zero();
  x.head<3>() = position;
  x.segment<4>(3) = quaternion_product<double>(level_gaze(heading_rad), quaternion_exp<double>(turn));
  return x;
}

inline const CameraState origin = camera_at({0, 0, 0});

template <class State, class Error>
State plus(const Chart& chart, State x, const Error& error) {
  chart.plus({x.data(), static_cast<std::size_t>(x.size())},
             {error.data(), static_cast<std::size_t>(error.size())});
  return x;
}

/// truth (-) estimate, 12 errors.
inline Eigen::Matrix<double, 12, 1> camera_error(const CameraState& truth, const CameraState& estimate) {
  Eigen::Matrix<double, 12, 1> e;
  FreeCameraMotion::chart.minus({truth.data(), 13}, {estimate.data(), 13}, {e.data(), 12});
  return e;
}

/// A camera covariance with every correlation, of about this size in position and rotation (m, rad).
inline CameraCov correlated_covariance(double sigma, std::uint64_t seed) {
  RandomStream random(seed, "covariance");
  CameraCov L;
  for (Eigen::Index i = 0; i < L.size(); ++i) L(i) = random.uniform(-0.3, 0.3);
  L += CameraCov::Identity();
  return sigma * sigma * L * L.transpose();
}

/// Jacobian of f: R^n -> R^m at zero, by central differences.
inline Eigen::MatrixXd numeric_jacobian(int n, double step,
                                        const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& f) {
  Eigen::MatrixXd J(f(Eigen::VectorXd::Zero(n)).size(), n);
  for (int i = 0; i < n; ++i) {
    const Eigen::VectorXd e = step * Eigen::VectorXd::Unit(n, i);
    J.col(i) = (f(e) - f(-e)) / (2 * step);
  }
  return J;
}

/// The plane x = distance_m, painted with squares of random grays, each of nine smaller ones so that no two
/// corners are alike, and, if wished, a black rectangle on white.
class Wall {
 public:
  static constexpr int cells = 64;

  explicit Wall(double distance_m, std::uint64_t seed = 1, double cell_m = 0.16)
      : distance_m_(distance_m), cell_m_(cell_m), grays_(cells * cells) {
    RandomStream random(seed, "wall");
    for (auto& gray : grays_) gray = static_cast<std::uint8_t>(20 + random.below(215));
  }

  /// Hangs a black rectangle in the middle of a white sheet around (y, z) = (0, 0).
  void hang_sheet(double half_width_m, double half_height_m, double margin_m) {
    half_width_m_ = half_width_m, half_height_m_ = half_height_m, margin_m_ = margin_m;
  }

  double distance_m() const { return distance_m_; }

  double gray(double y, double z) const {
    const double beyond = std::max(std::abs(y) - half_width_m_, std::abs(z) - half_height_m_);
    if (half_width_m_ > 0 && beyond < margin_m_) return beyond < 0 ? 15 : 240;
    return 0.6 * square(y, z, cell_m_) + 0.4 * square(y, z, cell_m_ / 3);
  }

  /// The point of the wall that is seen at a pixel.
  Eigen::Vector3d point_at(const CameraState& from, const Eigen::Vector2d& pixel) const {
    const Eigen::Vector3d ray =
        rotation_matrix<double>(free_camera::orientation(from)) * *camera.unproject(pixel);
    const Eigen::Vector3d position = free_camera::position(from);
    return position + ray * ((distance_m_ - position.x()) / ray.x());
  }

  /// Averages nine rays of each pixel, each in a row and a column of its own, so that edges along them are right to 1/18 px.
  /// Black where the wall is behind the camera.
  Image seen_from(const CameraState& from) const {
    Eigen::Matrix3d ray_of_pixel;  // of (u, v, 1), camera axes
    ray_of_pixel << 1 / model.fu, 0, -model.u0 / model.fu, 0, 1 / model.fv, -model.v0 / model.fv, 0, 0, 1;
    const Eigen::Matrix3d M = rotation_matrix<double>(free_camera::orientation(from)) * ray_of_pixel;
    const Eigen::Vector3d position = free_camera::position(from);
    const double ahead_m = distance_m_ - position.x();
    Image image(model.width, model.height);
    for (int v = 0; v < model.height; ++v)
      for (int u = 0; u < model.width; ++u) {
        double sum = 0;
        for (int k = 0; k < 9; ++k) {
          const double su = u + (k - 4) / 9.0, sv = v + (3 * (k % 3) + k / 3 - 4) / 9.0;
          const double along = M(0, 0) * su + M(0, 1) * sv + M(0, 2);
          if (along * ahead_m <= 0) continue;
          const double depth = ahead_m / along;
          sum += gray(position.y() + depth * (M(1, 0) * su + M(1, 1) * sv + M(1, 2)),
                      position.z() + depth * (M(2, 0) * su + M(2, 1) * sv + M(2, 2)));
        }
        image(u, v) = static_cast<std::uint8_t>(std::lround(sum / 9));
      }
    return image;
  }

  std::shared_ptr<const Image> shared_view(const CameraState& from) const {
    return std::make_shared<const Image>(seen_from(from));
  }

  /// Grid points of the texture, where four squares meet, at least `margin_px` inside the image.
  std::vector<Eigen::Vector3d> corners_in_view(const CameraState& from, double margin_px = 30) const {
    std::vector<Eigen::Vector3d> corners;
    for (int row = -cells; row < cells; ++row)
      for (int column = -cells; column < cells; ++column) {
        const Eigen::Vector3d at(distance_m_, column * cell_m_, row * cell_m_);
        const auto projected = camera.project(PointLandmark::in_camera<double>(from, at));
        if (projected && camera.contains(projected->pixel, margin_px)) corners.push_back(at);
      }
    return corners;
  }

 private:
  double square(double y, double z, double side_m) const {
    const int column = static_cast<int>(std::floor(y / side_m)) & (cells - 1);
    const int row = static_cast<int>(std::floor(z / side_m)) & (cells - 1);
    return grays_[row * cells + column];
  }

  double distance_m_, cell_m_;
  double half_width_m_ = 0, half_height_m_ = 0, margin_m_ = 0;
  std::vector<std::uint8_t> grays_;
};

inline Eigen::Vector2d pixel_of(const CameraState& from, const Eigen::Vector3d& point) {
  return camera.project(PointLandmark::in_camera<double>(from, point)).value().pixel;
}

inline Observation seeing(std::shared_ptr<const Image> image) {
  Observation observation;
  observation.bodies.emplace_back().images = {std::move(image)};
  return observation;
}

inline Observation seeing_gray(std::uint8_t gray) {
  return seeing(std::make_shared<const Image>(model.width, model.height, gray));
}

/// The k-th tick at 30 per second after a first one of any number and time.
inline Tick tick(int k, std::int64_t first_frame = 0, double first_t = 0) {
  return {first_frame + k, first_t + k / 30.0, k == 0 ? 0 : 1 / 30.0};
}

/// An estimate that is tracking and holds the camera alone.
inline Estimate estimate_at(const CameraState& x, const CameraCov& P) {
  Estimate estimate;
  Body& body = estimate.bodies.emplace_back();
  body.block = estimate.belief.add_vehicle(FreeCameraMotion::chart, x, P);
  body.state = x;
  body.state_covariance = P;
  body.pose_covariance = P.topLeftCorner<6, 6>();
  estimate.started = true;
  estimate.status.state = TrackingState::tracking;
  return estimate;
}

/// As in Appendix C of the thesis, whatever the image: few features, judged by all their searches.
inline CameraSlamSettings few_features() {
  CameraSlamSettings settings;
  settings.filter.sigma_acceleration_m_s2 = settings.filter.sigma_angular_acceleration_rad_s2 = 1;
  settings.filter.sigma_pixel_px = 1;
  settings.filter.adapt_sigma_pixel = false;
  settings.filter.sigma_start_velocity_m_s = settings.filter.sigma_start_angular_rate_rad_s = 0.2;
  settings.search.max_measurements = settings.map.wanted_visible = 12;
  settings.search.levels = 1;
  settings.search.align_images = false;
  settings.initialization.selection = InitializationSettings::Selection::random_box;
  settings.initialization.max_new_per_frame = 1;
  settings.initialization.min_corner_strength = 30;
  settings.initialization.scale_prior_to_view = InitializationSettings::ScalePrior::never;
  settings.initialization.second_order = false;
  settings.map.max_landmarks = 200;
  settings.bundle.adjust = false;
  settings.map.replace_when_full = false;
  settings.map.memory_attempts = 0;
  return settings;
}

/// The estimate and the camera that tracks with it.
struct Tracking {
  Estimate estimate;
  TrackedCamera tracked{.camera = camera};

  Tracking(const CameraState& x, const CameraCov& P, const CameraSlamSettings& settings = few_features())
      : estimate(estimate_at(x, P)) {
    tracked.settings = settings;
    tracked.view = viewpoint(estimate, tracked);
  }
  BlockId camera_block() const { return estimate.body().block; }
  Landmark& landmark(std::int64_t id) { return estimate.landmarks.at(id); }
  const Landmark& landmark(std::int64_t id) const { return estimate.landmarks.at(id); }
  Feature& feature(std::int64_t id) { return tracked.features.at(id); }
  const Feature& feature(std::int64_t id) const { return tracked.features.at(id); }

  /// Puts the camera elsewhere, correlations and covariance as they are but for `noise`.
  void move_to(const CameraState& to, double noise_var = 0) {
    estimate.belief.predict({camera_block(), to, CameraCov::Identity(), noise_var * CameraCov::Identity()});
    tracked.view = viewpoint(estimate, tracked);
  }
  bool initialize(const Image& image, const Eigen::Vector2d& pixel) {
    return initialize_from_image(ImagePyramid(image), pixel, estimate, tracked);
  }
  /// A point landmark independent of all else, its patch cut where `from` sees `seen_at` in `image`. Its id.
  std::int64_t add_point(const Image& image, const CameraState& from, const Eigen::Vector3d& seen_at,
                         const Eigen::Vector3d& mean, double sigma_m) {
    Landmark landmark;
    landmark.id = new_id(estimate);
    landmark.camera = 0;
    landmark.first_view = free_camera::position(from);
    landmark.block = estimate.belief.augment(PointLandmark::chart, mean, {},
                                             sigma_m * sigma_m * Eigen::Matrix3d::Identity());
    Feature feature;
    feature.view =
        cut_view(ImagePyramid(image), pixel_of(from, seen_at), from, camera, tracked.settings).value();
    feature.view.plane.facing = -Eigen::Vector3d::UnitX();
    feature.view.plane.slope_cov.setZero();
    tracked.features.emplace(landmark.id, std::move(feature));
    return estimate.landmarks.emplace(landmark.id, landmark).first->first;
  }
};

using Kind = LandmarkParametrization::Kind;

inline InverseDepthLandmark axes_of(const Landmark& landmark) {
  return InverseDepthLandmark{landmark.form.initial_axes};
}

}  // namespace incognita::synthetic
