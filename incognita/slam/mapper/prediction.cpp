#include "incognita/slam/mapper/prediction.hpp"

#include <algorithm>
#include <type_traits>

#include "incognita/belief/linearize.hpp"
#include "incognita/slam/mapper/invariant_errors.hpp"
#include "incognita/slam/mapper/measurements.hpp"

namespace incognita {
namespace {

template <class Model>
LinearizedMotion linearized_by(const Model& model, Linearization linearization, const AnyBelief& belief,
                               BlockId block, const SmallVector& input, const SmallMatrix& Q, double dt) {
  constexpr int m = Model::input_size;
  const typename Model::template Input<double> u = input;
  const Eigen::Matrix<double, m, m> noise = Q;
  if (linearization == Linearization::unscented_vehicle) return unscented(model, belief, block, u, noise, dt);
  return linearized(model, belief, block, u, noise, dt);
}

LinearizedMotion linearized_motion(const AnyMotion& motion, Linearization linearization,
                                   const AnyBelief& belief, BlockId block, const SmallVector& input,
                                   const SmallMatrix& Q, double dt) {
  return std::visit(
      [&](const auto& model) {
        return linearized_by(integrator_of(model), linearization, belief, block, input, Q, dt);
      },
      motion);
}

void predict(Estimate& e, std::size_t which, LinearizedMotion motion, const EstimatorSettings& settings) {
  Body& body = e.bodies[which];
  if (settings.filter.linearization == Linearization::first_estimate)
    motion.A =
        planar::jacobian_between(planar::Pose<double>(body.prediction), planar::Pose<double>(motion.x_next));
  body.prediction = motion.x_next;
  e.belief.predict(motion);
}

/// Share of the variance of a reading that is constant over `period` seconds, for a part of it: parts that add up to T
/// seconds give T^2 Q.
double variance_share(double period, double dt) { return std::max(1.0, period / dt); }

/// Predicts with one input held for `dt` seconds. Its noise is constant over a reading of `period` seconds.
void hold(Estimate& e, std::size_t which, const SmallVector& input, double dt, double period,
          const EstimatorSettings& settings) {
  const BodyModel& model = settings.bodies[which];
  const SmallMatrix Q = model.input_sigmas.cwiseAbs2().asDiagonal() * variance_share(period, dt);
  predict(e, which,
          linearized_motion(model.motion, settings.filter.linearization, e.belief, e.bodies[which].block,
                            input, Q, dt),
          settings);
}

/// The same with a twist, which has its own noise.
void hold_twist(Estimate& e, std::size_t which, const MeasuredTwist& twist, double dt,
                const EstimatorSettings& settings) {
  const SmallMatrix Q = twist.cov * variance_share(twist.period_s, dt);
  predict(e, which,
          linearized_by(PlanarTwist{}, settings.filter.linearization, e.belief, e.bodies[which].block,
                        twist.twist, Q, dt),
          settings);
}

void hold_until(Estimate& e, std::size_t which, double until, bool whole_us,
                const EstimatorSettings& settings) {
  Body& body = e.bodies[which];
  const double dt = duration_s(body.t, until, whole_us);
  if (!(dt > 0)) return;
  body.t = until;
  if (body.twist) return hold_twist(e, which, *body.twist, dt, settings);
  // The duration of the current reading is not known yet: that of the previous one is used
  if (body.input) hold(e, which, *body.input, dt, body.input_period, settings);
}

/// The twist of the point that is the state, from that of the axle.
std::optional<MeasuredTwist> twist_of_state(const Odometry& reading, const AnyMotion& motion) {
  if (!reading.twist) return std::nullopt;
  return std::visit(
      [&](const auto& model) {
        if constexpr (requires { model.point().forward_m; })
          return twist_of_point(*reading.twist, model.point().forward_m, model.point().left_m);
        else
          return *reading.twist;
      },
      motion);
}

void correct_by_fix(Estimate& e, std::size_t which, const PositionReading& fix,
                    const EstimatorSettings& settings) {
  const double sigma_m = settings.bodies[which].sigma_fix_m;
  const LinearizedMeasurement measurement = linearized_fix(e, which, fix.position, settings);
  e.last.update = e.belief.update({&measurement, 1});
  if (e.last.update.outcome == UpdateReport::Outcome::updated)
    e.last.fixes.push_back({static_cast<int>(which), fix.position, sigma_m});
  else
    e.last.refused = true;
}

/// Whether a fix is not the one that gave the start position.
bool is_new(const PositionReading& fix, const Body& body) {
  return !body.first_fix_t || fix.t > *body.first_fix_t;
}

/// Applies the readings and fixes of one vehicle in time order.
void predict_through_readings(Estimate& e, std::size_t which, const BodyObservation& view, const Tick& tick,
                              const EstimatorSettings& settings) {
  Body& body = e.bodies[which];
  // The odometry of a body in space is that of its carrier, and not its own input: its acceleration is unknown
  const bool moves_it = !traits_of(settings.bodies[which].motion).in_space();
  if (!moves_it) body.input = SmallVector::Zero(inputs_of(settings.bodies[which].motion));
  auto fix = view.fixes.begin();
  const auto use_fixes_until = [&](double until) {
    for (; settings.bodies[which].sigma_fix_m > 0 && fix != view.fixes.end() && fix->t <= until; ++fix) {
      if (fix->t < body.t || !is_new(*fix, body)) continue;  // from before the start
      hold_until(e, which, fix->t, tick.whole_us, settings);
      correct_by_fix(e, which, *fix, settings);
    }
  };
  for (const Odometry& reading : view.odometry) {
    if (!moves_it) break;
    use_fixes_until(reading.t);
    hold_until(e, which, reading.t, tick.whole_us, settings);
    if (body.input && reading.t > body.input_t)
      body.input_period = duration_s(body.input_t, reading.t, tick.whole_us);
    body.input = reading.input;
    body.twist = twist_of_state(reading, settings.bodies[which].motion);
    body.input_t = reading.t;
  }
  use_fixes_until(tick.t);
  hold_until(e, which, tick.t, tick.whole_us, settings);
}

}  // namespace

void add_jump(Estimate& e, std::size_t which, const Jump& jump, double dt) {
  const BlockId block = e.bodies[which].block;
  FreeCameraMotion::State<double> x = e.belief.mean(block);
  x.segment<4>(3) =
      quaternion_product<double>(x.segment<4>(3), quaternion_exp<double>(jump.turn)).normalized();
  Eigen::Matrix<double, FreeCameraMotion::error_size, 1> sigmas;
  sigmas << Eigen::Vector3d::Constant(jump.sigma_m), Eigen::Vector3d::Constant(jump.sigma_rad),
      Eigen::Vector3d::Constant(jump.sigma_m / dt), Eigen::Vector3d::Constant(jump.sigma_rad / dt);
  const SmallMatrix N = sigmas.cwiseAbs2().asDiagonal();
  e.belief.predict({block, x, FreeCameraMotion::Jacobian::Identity(), N});
}

UpdateReport update_with_wheel_odometry(AnyBelief& belief, BlockId camera, const WheelOdometry& odometry,
                                        const Eigen::Vector2d& wheels) {
  const WheelOdometry::Prediction expected =
      odometry.predict_measurement(FreeCameraMotion::State<double>(belief.mean(camera)));
  LinearizedMeasurement measurement;
  measurement.add(camera, expected.H);
  measurement.residual = WheelOdometry::measured(wheels) - expected.z;
  measurement.R = expected.R;
  return belief.update({&measurement, 1});
}

namespace {

/// Predicts by the command of the last tick; wheel readings of a carrier correct the result.
void predict_by_command(Estimate& e, std::size_t which, const SmallVector& commanded, double dt,
                        const EstimatorSettings& settings) {
  const BodyModel& model = settings.bodies[which];
  const Body& body = e.bodies[which];
  if (dt > 0) hold(e, which, commanded, dt, dt, settings);
  if (!model.wheels || !body.wheels) return;
  const SmallVector before = e.belief.mean(body.block);
  const UpdateReport update = update_with_wheel_odometry(e.belief, body.block, *model.wheels, *body.wheels);
  if (settings.filter.linearization == Linearization::invariant) keep_errors_invariant(e, body.block, before);
  if (update.outcome != UpdateReport::Outcome::updated) e.last.refused = true;
}

}  // namespace

void predict_body(Estimate& e, std::size_t which, const SmallVector& commanded,
                  const BodyObservation& observed, const Tick& tick, const EstimatorSettings& settings) {
  const bool by_command = settings.bodies[which].input == BodyModel::Input::commanded;
  if (!observed.input && !by_command) return predict_through_readings(e, which, observed, tick, settings);
  Body& body = e.bodies[which];
  if (by_command) {
    if (tick.t > body.t) predict_by_command(e, which, commanded, tick.dt, settings);
  } else {
    const double dt = duration_s(body.t, tick.t, tick.whole_us);
    if (dt > 0) hold(e, which, *observed.input, dt, dt, settings);
  }
  body.t = tick.t;
  for (const PositionReading& fix : observed.fixes)
    if (settings.bodies[which].sigma_fix_m > 0 && is_new(fix, body)) correct_by_fix(e, which, fix, settings);
}

void recenter_map(Estimate& e) {
  if (!e.world) return;
  const BlockId vehicle = e.body().block;
  const planar::Pose<double> moved = e.belief.mean(vehicle);
  const planar::FramedPose world = planar::in_frame(moved, planar::Pose<double>(e.belief.mean(*e.world)));
  std::vector<Belief::MovedBlock> others{{*e.world, world.pose, world.by_pose, world.by_frame}};
  for (const auto& [id, landmark] : e.landmarks) {
    if (landmark.fixed) continue;
    const planar::FramedPoint at = planar::in_frame(moved, Eigen::Vector2d(e.belief.mean(landmark.block)));
    others.push_back({landmark.block, at.point, at.by_point, at.by_frame});
  }
  const Eigen::Matrix3d zero = Eigen::Matrix3d::Zero();
  e.belief.change_frame({vehicle, Eigen::Vector3d::Zero(), zero, zero}, others);
  e.bodies.front().prediction = Eigen::Vector3d::Zero();
}

}  // namespace incognita
