#include "incognita/slam/points/team_motion.hpp"

#include <algorithm>
#include <type_traits>

#include "incognita/belief/linearise.hpp"
#include "incognita/models/held_acceleration.hpp"
#include "incognita/models/on_arc.hpp"

namespace incognita {
namespace {

template <class Model>
constexpr bool is_planar = std::is_same_v<Model, DifferentialDrive> || std::is_same_v<Model, AckermannCar>;

AffineMotion linearised_motion(const TeamMember& member, const std::string& lineariser,
                               const AnyBelief& belief, BlockId block, const SmallVector& input,
                               const SmallMatrix& Q, double dt) {
  const auto by = [&](const auto& model) {
    using Model = std::decay_t<decltype(model)>;
    constexpr int m = Model::input_size;
    const typename Model::template Input<double> u = input;
    const Eigen::Matrix<double, m, m> noise = Q;
    if (lineariser == "unscented-vehicle") return unscented(model, belief, block, u, noise, dt);
    return linearised(model, belief, block, u, noise, dt);
  };
  return std::visit(
      [&](const auto& model) {
        using Model = std::decay_t<decltype(model)>;
        if constexpr (is_planar<Model>)
          return by(OnArc<Model>{model});
        else if constexpr (std::is_same_v<Model, FreeCameraMotion>)
          return by(HeldAcceleration{});
        else
          return by(model);
      },
      member.motion);
}

/// One input held for so long. `period`: for how long its one draw of noise is held; of a piece of it each
/// has its share of the variance.
void hold(TeamEstimate& e, std::size_t which, const SmallVector& input, double dt, double period,
          const TeamSettings& settings) {
  const TeamMember& member = settings.members[which];
  TeamVehicle& vehicle = e.vehicles[which];
  const SmallMatrix Q = member.input_sigmas.cwiseAbs2().asDiagonal() * std::max(1.0, period / dt);
  AffineMotion motion =
      linearised_motion(member, settings.filter.lineariser, e.belief, vehicle.block, input, Q, dt);
  if (settings.filter.lineariser == "first-estimate")
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
  if (vehicle.input) hold(e, which, *vehicle.input, dt, vehicle.input_period, settings);
}

}  // namespace

void predict_vehicle(TeamEstimate& e, std::size_t which, const VehicleView& view, double t,
                     const TeamSettings& settings) {
  TeamVehicle& vehicle = e.vehicles[which];
  if (view.input) {
    const double dt = t - vehicle.t;
    if (dt > 0) hold(e, which, *view.input, dt, dt, settings);
    vehicle.t = t;
  } else {
    for (const Odometry& reading : view.odometry) {
      hold_until(e, which, reading.t, settings);
      if (vehicle.input && reading.t > vehicle.input_t) vehicle.input_period = reading.t - vehicle.input_t;
      vehicle.input = reading.input;
      vehicle.input_t = reading.t;
    }
    hold_until(e, which, t, settings);
  }
  vehicle.prediction = e.belief.mean(vehicle.block);
}

}  // namespace incognita
