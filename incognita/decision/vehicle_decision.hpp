// Decision of a vehicle that maps by the images of its camera; empty if its path is prescribed.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "incognita/decision/camera_decision.hpp"

namespace incognita {

class VehicleDecision {
 public:
  /// No decision: the goal is empty.
  VehicleDecision() = default;
  explicit VehicleDecision(CameraDecision decision) : decision_(std::move(decision)) {}

  Goal choose(const Estimate& estimate, const Observation& observation, const Tick& tick) {
    return decision_ ? decision_->choose(estimate, observation, tick) : Goal{};
  }
  const std::vector<std::string>& actions() const { return decision_ ? decision_->actions() : none_; }

 private:
  std::optional<CameraDecision> decision_;
  std::vector<std::string> none_;
};

}  // namespace incognita
