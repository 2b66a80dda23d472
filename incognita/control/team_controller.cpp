#include "incognita/control/team_controller.hpp"

namespace incognita {

Command TeamController::act(const TeamEstimate& estimate, const Goal&, const Tick& tick) {
  if (!first_t_) first_t_ = tick.t;
  Command command;
  if (!estimate.started || estimate.status.state == TrackingState::lost) return command;
  for (std::size_t i = 0; i < steering_.size(); ++i)
    command.inputs.push_back(
        steering_[i]->act(estimate.belief.mean(estimate.vehicles[i].block), tick.t - *first_t_));
  return command;
}

}  // namespace incognita
