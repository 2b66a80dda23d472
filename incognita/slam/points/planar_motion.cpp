#include "incognita/slam/points/planar_motion.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <variant>

#include "incognita/belief/linearise.hpp"
#include "incognita/models/planar_frame.hpp"
#include "incognita/slam/points/planar_looks.hpp"

namespace incognita {
namespace {

using Vehicle = std::variant<DifferentialDrive, AckermannCar>;

Vehicle vehicle_of(const VehicleSettings& s) {
  const DifferentialDrive body{s.sensor_forward_m, s.sensor_left_m};
  if (s.model == "differential-drive") return body;
  return AckermannCar{s.wheelbase_m, s.wheel_left_m, body};
}

/// Turn rate, rad/s.
double turn_rate(const VehicleSettings& s, const Eigen::Vector2d& input) {
  return std::visit(
      [&](const auto& model) {
        if constexpr (std::is_same_v<std::decay_t<decltype(model)>, AckermannCar>)
          return model.template at_axle<double>(input)[1];
        else
          return input[1];
      },
      vehicle_of(s));
}

Eigen::Matrix2d input_noise(const VehicleSettings& s) {
  const double second = s.model == "differential-drive" ? s.sigma_turn_rate_rad_s : s.sigma_steering_rad;
  return Eigen::Vector2d(s.sigma_speed_m_s, second).cwiseAbs2().asDiagonal();
}

}  // namespace

AffineMotion planar_motion(const PlanarEstimate& estimate, const Eigen::Vector2d& input, double dt,
                           const VehicleSettings& vehicle, const PlanarFilterSettings& filter) {
  // The noise is one draw per reading. Of a reading that is taken in pieces each has its share of the
  // variance: dt^2 Q (T / dt) summed over the pieces of T is T^2 Q. T is that of the reading before, as how
  // long this one will stand is not known yet
  const Eigen::Matrix2d Q = input_noise(vehicle) * std::max(1.0, estimate.input_period / dt);
  return std::visit(
      [&](const auto& model) {
        if (filter.lineariser == "unscented-vehicle")
          return unscented(model, estimate.belief, estimate.vehicle, input, Q, dt);
        return linearised(model, estimate.belief, estimate.vehicle, input, Q, dt);
      },
      vehicle_of(vehicle));
}

namespace {

/// The present input, held until a time. The models move along the tangent at a step's start, (3.16): a step
/// that turns far is taken in several.
void hold_until(PlanarEstimate& e, double until, const PlanarSlamSettings& settings) {
  constexpr double largest_turn_rad = 0.015, most_steps = 1000;
  const double dt = until - e.t;
  if (!(dt > 0)) return;
  e.t = until;
  if (!e.input) return;
  const double turn = std::abs(turn_rate(settings.vehicle, *e.input)) * dt;
  const double steps =
      std::isfinite(turn) ? std::clamp(std::ceil(turn / largest_turn_rad), 1.0, most_steps) : 1;
  for (int i = 0; i < static_cast<int>(steps); ++i) {
    AffineMotion motion = planar_motion(e, *e.input, dt / steps, settings.vehicle, settings.filter);
    const planar::Pose<double> next = motion.x_next;
    if (settings.filter.lineariser == "first-estimate")
      motion.A = planar::jacobian_between(e.first_prediction, next);
    e.first_prediction = next;
    e.belief.predict(motion);
  }
}

}  // namespace

bool predict_through(PlanarEstimate& e, const Observation& seen, double t,
                     const PlanarSlamSettings& settings) {
  bool usable = true;
  auto fix = seen.fixes.begin();
  const auto use_fixes_until = [&](double until) {
    for (; settings.filter.use_fixes && fix != seen.fixes.end() && fix->t <= until; ++fix) {
      if (fix->t < e.t) continue;  // from before the start
      hold_until(e, fix->t, settings);
      const AffineLook look = look_of_fix(e, fix->position, settings.filter.sigma_fix_m);
      e.update = e.belief.update({&look, 1});
      const bool used = e.update.outcome == UpdateReport::Outcome::updated;
      if (used) e.fixes.push_back({fix->position, settings.filter.sigma_fix_m});
      usable = usable && used;
    }
  };
  for (const Odometry& reading : seen.odometry) {
    use_fixes_until(reading.t);
    hold_until(e, reading.t, settings);
    if (e.input && reading.t > e.input_t) e.input_period = reading.t - e.input_t;
    e.input = reading.input;
    e.input_t = reading.t;
  }
  use_fixes_until(t);
  hold_until(e, t, settings);
  return usable;
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
