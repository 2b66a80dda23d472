#include "incognita/slam/points/team_motion.hpp"

#include <algorithm>
#include <type_traits>

#include "incognita/belief/linearize.hpp"
#include "incognita/slam/points/team_measurements.hpp"

namespace incognita {
namespace {

LinearizedMotion linearized_motion(const TeamMember& member, const std::string& linearization,
                                   const AnyBelief& belief, BlockId block, const SmallVector& input,
                                   const SmallMatrix& Q, double dt) {
  const auto by = [&](const auto& model) {
    using Model = std::decay_t<decltype(model)>;
    constexpr int m = Model::input_size;
    const typename Model::template Input<double> u = input;
    const Eigen::Matrix<double, m, m> noise = Q;
    if (linearization == "unscented-vehicle") return unscented(model, belief, block, u, noise, dt);
    return linearized(model, belief, block, u, noise, dt);
  };
  return std::visit([&](const auto& model) { return by(integrator_of(model)); }, member.motion);
}

/// Predicts with one input held for `dt` seconds. Its noise is constant over a reading of `period` seconds: a
/// part of a reading gets a share of the variance such that parts that add up to T seconds give T^2 Q.
void hold(TeamEstimate& e, std::size_t which, const SmallVector& input, double dt, double period,
          const TeamSettings& settings) {
  const TeamMember& member = settings.members[which];
  TeamVehicle& vehicle = e.vehicles[which];
  const SmallMatrix Q = member.input_sigmas.cwiseAbs2().asDiagonal() * std::max(1.0, period / dt);
  LinearizedMotion motion =
      linearized_motion(member, settings.filter.linearization, e.belief, vehicle.block, input, Q, dt);
  if (settings.filter.linearization == "first-estimate")
    motion.A = planar::jacobian_between(planar::Pose<double>(vehicle.prediction),
                                        planar::Pose<double>(motion.x_next));
  vehicle.prediction = motion.x_next;
  e.belief.predict(motion);
}

void hold_until(TeamEstimate& e, std::size_t which, double until, const TeamSettings& settings) {
  TeamVehicle& vehicle = e.vehicles[which];
  const double dt = until - vehicle.t;
  if (!(dt > 0)) return;
  vehicle.t = until;
  // The duration of the current reading is not known yet: that of the previous one is used
  if (vehicle.input) hold(e, which, *vehicle.input, dt, vehicle.input_period, settings);
}

void correct_by_fix(TeamEstimate& e, std::size_t which, const PositionReading& fix,
                    const TeamSettings& settings) {
  const double sigma_m = settings.members[which].sigma_fix_m;
  const LinearizedMeasurement measurement = linearized_fix(e, which, fix.position, settings);
  e.update = e.belief.update({&measurement, 1});
  if (e.update.outcome == UpdateReport::Outcome::updated)
    e.fixes.push_back({static_cast<int>(which), fix.position, sigma_m});
  else
    e.refused = true;
}

/// Applies the readings and fixes of one vehicle in time order.
void predict_through_readings(TeamEstimate& e, std::size_t which, const BodyObservation& view, double t,
                              const TeamSettings& settings) {
  TeamVehicle& vehicle = e.vehicles[which];
  auto fix = view.fixes.begin();
  const auto use_fixes_until = [&](double until) {
    for (; settings.members[which].sigma_fix_m > 0 && fix != view.fixes.end() && fix->t <= until; ++fix) {
      if (fix->t < vehicle.t) continue;  // from before the start
      hold_until(e, which, fix->t, settings);
      correct_by_fix(e, which, *fix, settings);
    }
  };
  for (const Odometry& reading : view.odometry) {
    use_fixes_until(reading.t);
    hold_until(e, which, reading.t, settings);
    if (vehicle.input && reading.t > vehicle.input_t) vehicle.input_period = reading.t - vehicle.input_t;
    vehicle.input = reading.input;
    vehicle.input_t = reading.t;
  }
  use_fixes_until(t);
  hold_until(e, which, t, settings);
}

}  // namespace

void predict_vehicle(TeamEstimate& e, std::size_t which, const BodyObservation& view, double t,
                     const TeamSettings& settings) {
  TeamVehicle& vehicle = e.vehicles[which];
  if (!view.input) return predict_through_readings(e, which, view, t, settings);
  const double dt = t - vehicle.t;
  if (dt > 0) hold(e, which, *view.input, dt, dt, settings);
  vehicle.t = t;
  for (const PositionReading& fix : view.fixes)
    if (settings.members[which].sigma_fix_m > 0) correct_by_fix(e, which, fix, settings);
}

void recenter_map(TeamEstimate& e) {
  if (!e.world) return;
  const BlockId vehicle = e.vehicles.front().block;
  const planar::Pose<double> moved = e.belief.mean(vehicle);
  const planar::FramedPose world = planar::in_frame(moved, planar::Pose<double>(e.belief.mean(*e.world)));
  std::vector<Belief::MovedBlock> others{{*e.world, world.pose, world.by_pose, world.by_frame}};
  for (const auto& [identity, landmark] : e.landmarks) {
    const planar::FramedPoint at = planar::in_frame(moved, Eigen::Vector2d(e.belief.mean(landmark.block)));
    others.push_back({landmark.block, at.point, at.by_point, at.by_frame});
  }
  const Eigen::Matrix3d zero = Eigen::Matrix3d::Zero();
  e.belief.change_frame({vehicle, Eigen::Vector3d::Zero(), zero, zero}, others);
  e.vehicles.front().prediction = Eigen::Vector3d::Zero();
}

}  // namespace incognita
