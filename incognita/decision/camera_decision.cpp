#include "incognita/decision/camera_decision.hpp"

#include <algorithm>
#include <utility>

#include "incognita/decision/extended_entropy.hpp"
#include "incognita/slam/mapper/entropy_values.hpp"

namespace incognita {
namespace {

std::variant<FreeCameraChoice, VehicleChoice> choice_of(const DecisionSettings& settings,
                                                        const FilterSettings& filter,
                                                        const std::optional<CarrierSettings>& carrier,
                                                        std::uint64_t seed) {
  const double linear = filter.sigma_acceleration_m_s2, angular = filter.sigma_angular_acceleration_rad_s2;
  if (carrier) return VehicleChoice(settings, *carrier, linear, angular, seed);
  return FreeCameraChoice(settings, linear, angular, seed);
}

}  // namespace

CameraDecision::CameraDecision(Camera camera, const CameraSlamSettings& slam,
                               const DecisionSettings& settings, const ExplorationSettings& exploration,
                               std::uint64_t seed, const std::optional<CarrierSettings>& carrier)
    : expectation_(std::move(camera), slam, exploration.counted == ExplorationSettings::Counted::as_mapped),
      exploration_(exploration, seed),
      choice_(choice_of(settings, slam.filter, carrier, seed)),
      names_(std::visit([](const auto& choice) { return choice.names(); }, choice_)) {}

void CameraDecision::explore(const Estimate& estimate, const Tick& tick) {
  if (exploration_.settings().expected_landmarks == 0) return;
  const CameraState now = estimate.camera_state();
  exploration_.update([&](const Eigen::Vector3d& position) { return expectation_.in_view(now, position); },
                      tick.dt, estimate.mapped_count());
  goal_.coverage = exploration_.coverage();
}

Goal CameraDecision::choose(const Estimate& estimate, const Observation&, const Tick& tick) {
  goal_.decided = false;
  if (!estimate.started || estimate.status.state == TrackingState::lost) {
    std::visit([](auto& choice) { choice.forget(); }, choice_);
    goal_.chosen = -1;
    goal_.drive.reset();
    goal_.scores.assign(actions().size(), 0);
    return goal_;
  }
  explore(estimate, tick);
  expectation_.prepare(estimate, exploration_.expected(), exploration_.settings().variance_expected_m2);
  const CameraState camera = estimate.camera_state();
  if (auto* flies = std::get_if<FreeCameraChoice>(&choice_)) {
    flies->choose(estimate.belief, estimate.body().block, camera, expectation_, tick, goal_);
  } else {
    std::get<VehicleChoice>(choice_).choose(estimate.belief, estimate.body().block, camera,
                                            estimate.body().wheels, expectation_, tick, goal_);
  }
  if (goal_.decided && exploration_.settings().expected_landmarks > 0 &&
      (!entropy_due_t_ || has_come(*entropy_due_t_, tick.t))) {
    goal_.entropy_extended = extended_entropy(estimate, exploration_.settings());
    entropy_due_t_ = tick.t + entropy_period_s(estimate.belief.errors());
  }
  return goal_;
}

}  // namespace incognita
