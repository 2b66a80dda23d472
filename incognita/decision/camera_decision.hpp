// Next action of a camera that maps by its images: the most informative one (thesis 6.2). The camera flies
// (6.3.1) or is carried by a vehicle (6.4.2).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "incognita/decision/camera_expectation.hpp"
#include "incognita/decision/exploration.hpp"
#include "incognita/decision/free_camera_choice.hpp"
#include "incognita/decision/settings.hpp"
#include "incognita/decision/strategy.hpp"
#include "incognita/decision/vehicle_choice.hpp"
#include "incognita/slam/features/settings.hpp"

namespace incognita {

class CameraDecision final : public Strategy {
 public:
  /// `carrier`: the vehicle that carries the camera; empty for a flying camera. Throws std::invalid_argument
  /// for invalid settings.
  CameraDecision(Camera camera, const CameraSlamSettings& slam, const DecisionSettings& settings,
                 const ExplorationSettings& exploration = {}, std::uint64_t seed = 1,
                 const std::optional<CarrierSettings>& carrier = {});

  /// Scores the actions as the schedule asks; compares them and sets a new goal once per period. Actions that
  /// would end outside the bounds are scored but not chosen. No action is chosen without a pose (not started,
  /// lost). `observation`: its odometry is the wheel speeds of a carrier; may be empty.
  Goal choose(const Estimate& estimate, const Observation& observation, const Tick& tick) override;
  Goal choose(const Estimate& estimate, const Tick& tick) { return choose(estimate, {}, tick); }

  const std::vector<std::string>& actions() const override { return names_; }

 private:
  void explore(const Estimate& estimate, const Tick& tick);

  CameraExpectation expectation_;
  Exploration exploration_;
  std::variant<FreeCameraChoice, VehicleChoice> choice_;
  std::vector<std::string> names_;
  Goal goal_;
  std::optional<double> entropy_due_t_;  ///< s, next evaluation of the extended entropy
};

}  // namespace incognita
