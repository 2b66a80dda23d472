#include "incognita/decision/taken_over.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

namespace incognita {

void TakenOver::give_back(std::size_t body) {
  if (drives_.erase(body) > 0) strategy_->restart(body);
}

void TakenOver::drive(const DriveBody& drive) {
  const auto found = drives_.find(drive.body);
  if (found == drives_.end())
    throw std::invalid_argument("body " + std::to_string(drive.body + 1) +
                                " is not taken over; take it over before driving it");
  if (!(drive.direction.cwiseAbs().maxCoeff() <= 1) || !(std::abs(drive.turn) <= 1))
    throw std::invalid_argument("drive: direction and turn must be within -1 and 1");
  found->second = {drive.direction, drive.turn};
}

Goal TakenOver::choose(const Estimate& estimate, const Observation& observation, const Tick& tick) {
  Goal goal = strategy_->choose(estimate, observation, tick);
  for (const auto& [body, drive] : drives_) {
    if (goal.bodies.size() <= body) goal.bodies.resize(body + 1);
    goal.bodies[body].chosen = -1;
    goal.bodies[body].decided = false;
    goal.bodies[body].manual = drive;
  }
  return goal;
}

}  // namespace incognita
