// The state of the controllers.
#include "incognita/control/body_controller.hpp"
#include "incognita/messages/saved_messages.hpp"

namespace incognita {

template <AnyStateArchive Archive>
void serialize(Archive& archive, PointPath& path) {
  auto& [position, heading_rad] = path;
  archive(position, heading_rad);
}

void ManualFlight::state(StateArchive& archive) {
  auto& [reference, last_t] = *this;
  archive(reference, last_t);
}

void ManualDisplay::state(StateArchive& archive) {
  auto& [shown] = *this;
  archive(shown);
}

/// Of the path only a goal that head_for() took for it; the other kinds are configuration.
void BodyController::state(StateArchive& archive) {
  auto& [control, period_s, law, last_known, lost_t, first_heading, first_t, turn_side, flight, display] =
      *this;
  std::optional<PointPath> goal;
  if (const auto* point = std::get_if<PointPath>(&control.steering.path)) goal = *point;
  archive(goal, last_known, lost_t, first_heading, first_t, turn_side, flight, display);
  if (!archive.restores() || !goal) return;
  control.steering.path = *goal;
  law = make_steering(control.motion, control.steering, period_s);
}

}  // namespace incognita
