#include "incognita/decision/ground_actions.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace incognita {
namespace {

/// Removes sideways translations for a vehicle on a line, and vertical ones for all.
std::vector<Translation> possible(const AnyMotion& motion, std::vector<Translation> actions) {
  const bool line = traits_of(motion).on_line();
  std::erase_if(actions, [&](const Translation& a) {
    return a.displacement_m.z() != 0 || (line && a.displacement_m.y() != 0);
  });
  return actions;
}

}  // namespace

GroundActions::GroundActions(const BodyModel& member, const std::vector<Translation>& actions,
                             double period_s, double tick_s, const WorldBounds& bounds)
    : member_(member),
      actions_(possible(member.motion, actions)),
      steps_(std::max(1, static_cast<int>(std::lround(period_s / tick_s)))),
      bounds_(bounds),
      stay_(find_stay(actions_)) {
  step_s_ = period_s / steps_;
}

ActionOutcome GroundActions::after(const BlockVector& state, int action) const {
  const MotionTraits& motion = traits_of(member_.motion);
  const double heading = heading_by(member_.motion, state);
  const Eigen::Vector3d way = Eigen::AngleAxisd(heading, Eigen::Vector3d::UnitZ()) *
                              actions_[static_cast<std::size_t>(action)].displacement_m;
  ActionOutcome out{state, {}, {}};
  out.state.head(motion.position_size) += way.head(motion.position_size);
  if (!motion.on_line() && !way.isZero()) out.state[2] = std::atan2(way.y(), way.x());
  const int errors = chart_of(member_.motion).tangent();
  const AnyStep step =
      step_of(member_.motion, out.state, SmallVector::Zero(inputs_of(member_.motion)), step_s_);
  const SmallMatrix noise = step.G * member_.input_sigmas.cwiseAbs2().asDiagonal() * step.G.transpose();
  out.A = SmallMatrix::Identity(errors, errors);
  out.N = SmallMatrix::Zero(errors, errors);
  for (int i = 0; i < steps_; ++i) {
    out.A = (step.F * out.A).eval();
    out.N = (step.F * out.N * step.F.transpose() + noise).eval();
  }
  if (action != stay_) out.outside_m = bounds_.outside_m(pose_of(member_.motion, out.state).position);
  return out;
}

}  // namespace incognita
