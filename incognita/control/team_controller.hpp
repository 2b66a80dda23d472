// Steers each vehicle of a team along a path of its own.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "incognita/control/steering.hpp"
#include "incognita/messages/command.hpp"
#include "incognita/messages/goal.hpp"
#include "incognita/messages/tick.hpp"
#include "incognita/slam/team_estimate.hpp"

namespace incognita {

class TeamController {
 public:
  explicit TeamController(std::vector<std::unique_ptr<Steering>> steering) : steering_(std::move(steering)) {}

  /// Nothing before the start and once lost.
  Command act(const TeamEstimate& estimate, const Goal& goal, const Tick& tick);

 private:
  std::vector<std::unique_ptr<Steering>> steering_;
  std::optional<double> first_t_;
};

}  // namespace incognita
