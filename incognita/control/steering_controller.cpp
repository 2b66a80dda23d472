#include "incognita/control/steering_controller.hpp"

#include <algorithm>
#include <utility>

#include "incognita/math/saved_state/matrices.hpp"

namespace incognita {

SteeringController::SteeringController(std::vector<BodyControl> bodies, double period_s) {
  for (BodyControl& body : bodies) bodies_.emplace_back(std::move(body), period_s);
}

Command SteeringController::act(const Estimate& estimate, const Goal& goal, const Observation& observation,
                                const Tick& tick) {
  if (!first_t_) first_t_ = tick.t;
  Command command;
  if (!estimate.started) return command;
  for (std::size_t i = 0; i < std::min(bodies_.size(), estimate.bodies.size()); ++i) {
    const BodyGoal* own = i < goal.bodies.size() ? &goal.bodies[i] : nullptr;
    command.bodies.push_back(is_lost(estimate, i)
                                 ? bodies_[i].act_when_lost(own, body_of(observation, i), tick.t)
                                 : bodies_[i].act(estimate.bodies[i].state, own, body_of(observation, i),
                                                  tick.t, tick.t - *first_t_));
  }
  return command;
}

void SteeringController::state(StateArchive& archive) {
  auto& [bodies, first_t] = *this;
  archive.each(bodies, "controlled bodies");
  archive(first_t);
}

}  // namespace incognita
