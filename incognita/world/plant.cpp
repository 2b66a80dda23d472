#include "incognita/world/plant.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <stdexcept>
#include <utility>

#include "incognita/world/integrate.hpp"

namespace incognita {
namespace {

void need_size(const SmallVector& v, int size, const char* what) {
  if (v.size() != size)
    throw std::invalid_argument(std::string(what) + ": " + std::to_string(v.size()) + " numbers, expected " +
                                std::to_string(size));
  if (!v.allFinite()) throw std::invalid_argument(std::string(what) + " must be finite");
}

/// Checks the values of settings that have the right sizes.
void check_numbers(const FreeCameraMotion&, const PlantSettings& s) {
  if (std::abs(free_camera::orientation(s.start).norm() - 1) > 1e-6)
    throw std::invalid_argument("the orientation at the start of a plant must be a unit quaternion");
}
void check_numbers(const AckermannCar& car, const PlantSettings& s) {
  const double ratio = s.input_ratios.size() > 0 ? s.input_ratios[1] : 1;
  for (const double steering : {ratio * s.least_input[1], ratio * s.most_input[1]}) {
    const bool to_a_side = std::abs(steering) < std::numbers::pi / 2;
    if (to_a_side && std::tan(steering) * car.wheel_left_m < car.wheelbase_m) continue;
    throw std::invalid_argument(
        "steering angle " + std::to_string(steering) +
        " rad: the turning center is at the wheel whose speed is measured, or nearer");
  }
}
void check_numbers(const auto& model, const PlantSettings& s) {
  if constexpr (requires { model.steered_as(); }) check_numbers(model.steered_as(), s);
}

void check(const AnyMotion& motion, const PlantSettings& s) {
  const Chart& chart = chart_of(motion);
  const int inputs = inputs_of(motion);
  need_size(s.start, chart.ambient(), "the start of a plant");
  need_size(s.start_sigmas, chart.tangent(), "the sigmas of a plant's start");
  need_size(s.input_sigmas, inputs, "the sigmas of a plant's inputs");
  need_size(s.least_input, inputs, "the lower limits of a plant's inputs");
  need_size(s.most_input, inputs, "the upper limits of a plant's inputs");
  if (s.input_ratios.size() > 0) need_size(s.input_ratios, inputs, "the ratios of a plant's inputs");
  if ((s.start_sigmas.array() < 0).any() || (s.input_sigmas.array() < 0).any())
    throw std::invalid_argument("the sigmas of a plant must be zero or positive");
  if ((s.least_input.array() > s.most_input.array()).any())
    throw std::invalid_argument("a lower limit of a plant's inputs exceeds the upper one");
  std::visit([&](const auto& model) { check_numbers(model, s); }, motion);
}

/// Keeps the disturbed steering angle short of the one at which the car would turn about the measured wheel.
void keep_steering(const AckermannCar& car, SmallVector& input) {
  const double margin = 0.01;
  const double inside =
      car.wheel_left_m == 0 ? std::numbers::pi / 2 : std::atan2(car.wheelbase_m, std::abs(car.wheel_left_m));
  const double left = car.wheel_left_m > 0 ? inside : std::numbers::pi / 2,
               right = car.wheel_left_m < 0 ? inside : std::numbers::pi / 2;
  input[1] = std::clamp(input[1], -right + margin, left - margin);
}
void keep_steering(const auto& model, SmallVector& input) {
  if constexpr (requires { model.steered_as(); }) keep_steering(model.steered_as(), input);
}

std::span<double> numbers(SmallVector& v) { return {v.data(), static_cast<std::size_t>(v.size())}; }

SmallVector drawn_start(const AnyMotion& motion, const PlantSettings& s, std::uint64_t seed,
                        const std::string& name) {
  RandomStream random(seed, name + ".start");
  SmallVector x = s.start, shift = s.start_sigmas;
  for (double& number : shift) number *= random.normal();
  chart_of(motion).plus(numbers(x), numbers(shift));
  return x;
}

}  // namespace

Plant::Plant(AnyMotion motion, const PlantSettings& settings, std::uint64_t seed, const std::string& name)
    : motion_(std::move(motion)), settings_(settings), disturbance_(seed, name + ".disturbance") {
  check(motion_, settings_);
  state_ = drawn_start(motion_, settings_, seed, name);
  executed_ = in_force_ = SmallVector::Zero(inputs_of(motion_));
}

const SmallVector& Plant::move(const SmallVector& input, double dt_s) {
  need_size(input, inputs_of(motion_), "the input of a plant");
  if (!(dt_s >= 0 && std::isfinite(dt_s)))
    throw std::invalid_argument("a tick must last zero or more seconds, got " + std::to_string(dt_s));
  if (dt_s == 0) return state_;
  executed_ = input.cwiseMax(settings_.least_input).cwiseMin(settings_.most_input);
  SmallVector u = executed_;
  if (settings_.input_ratios.size() > 0) u.array() *= settings_.input_ratios.array();
  for (Eigen::Index i = 0; i < u.size(); ++i) u[i] += settings_.input_sigmas[i] * disturbance_.normal();
  std::visit([&](const auto& model) { keep_steering(model, u); }, motion_);
  state_ = integrate(motion_, state_, u, dt_s);
  in_force_ = u;
  return state_;
}

void Plant::put(const SmallVector& state) {
  need_size(state, chart_of(motion_).ambient(), "the state of a plant");
  state_ = state;
}

}  // namespace incognita
