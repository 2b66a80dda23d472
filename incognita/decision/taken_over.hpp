// A strategy from which a person can take over bodies, and give them back.
#pragma once

#include <map>
#include <memory>

#include "incognita/decision/strategy.hpp"
#include "incognita/messages/intervention.hpp"

namespace incognita {

class TakenOver final : public Strategy {
 public:
  explicit TakenOver(std::unique_ptr<Strategy> strategy) : strategy_(std::move(strategy)) {}

  void take_over(std::size_t body) { drives_[body] = {}; }
  void give_back(std::size_t body);
  void give_back_all() { drives_.clear(); }
  /// Throws std::invalid_argument for a body that is not taken over, or shares outside -1 to 1.
  void drive(const DriveBody& drive);

  /// The goal of the strategy; no action of a body that is taken over is chosen, its scores stay.
  Goal choose(const Estimate& estimate, const Observation& observation, const Tick& tick) override;
  void state(StateArchive& archive) override;
  const std::vector<std::string>& actions(std::size_t body) const override {
    return strategy_->actions(body);
  }

  Strategy& strategy() { return *strategy_; }

 private:
  std::unique_ptr<Strategy> strategy_;
  std::map<std::size_t, ManualDrive> drives_;  ///< of the bodies that are taken over
};

}  // namespace incognita
