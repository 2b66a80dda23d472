#include "incognita/world/operator_model.hpp"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "incognita/messages/tick.hpp"
#include "incognita/models/motion/heading.hpp"

namespace incognita {
namespace {

using Input = FreeCameraMotion::Input<double>;
using State = FreeCameraMotion::State<double>;

/// A displacement, its opposite, and four perpendicular ones of the same length.
std::array<Eigen::Vector3d, 6> six_directions(const Eigen::Vector3d& displacement) {
  const bool vertical = std::abs(displacement.z()) > displacement.head<2>().norm();
  const Eigen::Vector3d reference = vertical ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d a = displacement.norm() * displacement.cross(reference).normalized(),
                        b = displacement.norm() * displacement.cross(a).normalized();
  return {displacement, -displacement, a, -a, b, -b};
}

void need(bool ok, const char* key, double value, const char* limit) {
  if (!ok)
    throw std::invalid_argument(std::string(key) + " = " + std::to_string(value) + ": must be " + limit);
}

}  // namespace

OperatorModel::OperatorModel(const OperatorSettings& settings, std::uint64_t seed, const std::string& name)
    : settings_(settings), random_(seed, name) {
  need(settings_.delay_s >= 0, "operator.delay_s", settings_.delay_s, "0 or more");
  need(settings_.wrong >= 0 && settings_.wrong <= 1, "operator.wrong_probability", settings_.wrong, "0 to 1");
  need(settings_.sigma_way_ratio >= 0, "operator.sigma_length_ratio", settings_.sigma_way_ratio, "0 or more");
}

/// Always draws three random numbers, so that runs with different error probabilities use the same draws.
Eigen::Vector3d OperatorModel::understood(const Eigen::Vector3d& displacement) {
  const bool wrong = random_.uniform(0, 1) < settings_.wrong;
  const int other = 1 + random_.below(5);
  const double far = std::max(0.0, 1 + settings_.sigma_way_ratio * random_.normal());
  if (displacement.isZero()) return displacement;
  return far * six_directions(displacement)[wrong ? static_cast<std::size_t>(other) : 0];
}

void OperatorModel::forget() {
  waiting_.clear();
  started_ = false;
}

const Segment& OperatorModel::follow(const UserCommand& shown, const Eigen::Vector3d& at, double t) {
  if (!started_) in_progress_ = {at, at, t, t};
  started_ = true;
  if (shown.is_new) waiting_.push_back(shown.segment);
  while (!waiting_.empty() && has_come(waiting_.front().start_t + settings_.delay_s, t)) {
    const Segment& now = waiting_.front();
    in_progress_ = {at, at + understood(now.to - now.from), t, t + now.end_t - now.start_t};
    waiting_.pop_front();
  }
  return in_progress_;
}

OperatorActuator::OperatorActuator(OperatorModel model, OperatorMotion motion, const GazeSwing& swing)
    : model_(std::move(model)), motion_(std::move(motion)), swing_(swing) {}

Input OperatorActuator::move(const BodyCommand& command, const State& state, double t) {
  if (!command.operator_controlled) return Input::Zero();
  if (!command.shown) return stop(state, t);
  stopped_.reset();
  const Heading heading = gaze(*command.shown, state, t);
  return motion_(state, model_.follow(*command.shown, free_camera::position(state), t), heading, t);
}

/// Stops within half a second, from the motion when the screen went dark.
Input OperatorActuator::stop(const State& state, double t) {
  constexpr double braking_s = 0.5;
  if (!stopped_) stopped_ = {state, t};
  model_.forget();
  if (t - stopped_->t >= braking_s) return Input::Zero();
  return -stopped_->camera.tail<6>() / braking_s;
}

Heading OperatorActuator::gaze(const UserCommand& shown, const State& state, double t) {
  if (shown.gaze) return *shown.gaze;
  if (!first_gaze_) {
    first_gaze_ = {heading_of(free_camera::orientation(state)), 0};
    swing_start_t_ = t;
  }
  return swing_.at(first_gaze_->rad, t - swing_start_t_);
}

}  // namespace incognita
