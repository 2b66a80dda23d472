#include "incognita/slam/planar_motion.hpp"

#include <variant>

#include "incognita/belief/linearise.hpp"
#include "incognita/models/planar_frame.hpp"

namespace incognita {
namespace {

using Vehicle = std::variant<DifferentialDrive, AckermannCar>;

Vehicle vehicle_of(const VehicleSettings& s) {
  const DifferentialDrive body{s.sensor_forward_m, s.sensor_left_m};
  if (s.model == "differential-drive") return body;
  return AckermannCar{s.wheelbase_m, s.wheel_left_m, body};
}

Eigen::Matrix2d input_noise(const VehicleSettings& s) {
  const double second = s.model == "differential-drive" ? s.sigma_turn_rate_rad_s : s.sigma_steering_rad;
  return Eigen::Vector2d(s.sigma_speed_m_s, second).cwiseAbs2().asDiagonal();
}

}  // namespace

AffineMotion planar_motion(const PlanarEstimate& estimate, const Eigen::Vector2d& input, double dt,
                           const VehicleSettings& vehicle, const PlanarFilterSettings& filter) {
  const Eigen::Matrix2d Q = input_noise(vehicle);
  return std::visit(
      [&](const auto& model) {
        if (filter.lineariser == "unscented-vehicle")
          return unscented(model, estimate.belief, estimate.vehicle, input, Q, dt);
        return linearised(model, estimate.belief, estimate.vehicle, input, Q, dt);
      },
      vehicle_of(vehicle));
}

void predict_through(PlanarEstimate& e, const std::vector<Odometry>& odometry, double t,
                     const PlanarSlamSettings& settings) {
  const bool first_estimate = settings.filter.lineariser == "first-estimate";
  const auto hold_until = [&](double until) {
    const double dt = until - e.t;
    if (!(dt > 0)) return;
    e.t = until;
    if (!e.input) return;
    AffineMotion motion = planar_motion(e, *e.input, dt, settings.vehicle, settings.filter);
    if (first_estimate) {
      const planar::Pose<double> next = motion.x_next;
      motion.A = planar::jacobian_between(e.first_prediction, next);
      e.first_prediction = next;
    }
    e.belief.predict(motion);
  };
  for (const Odometry& reading : odometry) {
    hold_until(reading.t);
    e.input = reading.input;
  }
  hold_until(t);
  if (!first_estimate) e.first_prediction = e.belief.mean(e.vehicle);
}

void tell_from_vehicle(PlanarEstimate& e) {
  if (!e.world) return;
  const planar::Pose<double> moved = e.belief.mean(e.vehicle);
  const planar::FramedPose world = planar::in_frame(moved, planar::Pose<double>(e.belief.mean(*e.world)));
  std::vector<Belief::Carried> others{{*e.world, world.pose, world.by_pose, world.by_frame}};
  for (const PlanarLandmark& landmark : e.catalogue) {
    if (landmark.anchor) continue;
    const planar::FramedPoint seen = planar::in_frame(moved, Eigen::Vector2d(e.belief.mean(landmark.block)));
    others.push_back({landmark.block, seen.point, seen.by_point, seen.by_frame});
  }
  const Eigen::Matrix3d zero = Eigen::Matrix3d::Zero();
  e.belief.carry({e.vehicle, Eigen::Vector3d::Zero(), zero, zero}, others);
}

}  // namespace incognita
