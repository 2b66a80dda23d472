#include "incognita/control/feedback_linearization.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

#include "incognita/control/held_command.hpp"
#include "incognita/models/motion/planar_frame.hpp"

namespace incognita {

Eigen::Matrix2d point_velocity_by_input(const DifferentialDrive& body, double heading) {
  const Eigen::Matrix2d in_body = (Eigen::Matrix2d() << 1, -body.left_m, 0, body.forward_m).finished();
  return planar::rotation(heading) * in_body;
}

Eigen::Vector2d input_for_velocity(const DifferentialDrive& body, double heading,
                                   const Eigen::Vector2d& velocity) {
  const Eigen::Vector2d in_body = planar::rotation(heading).transpose() * velocity;
  const double turn_rate = in_body.y() / body.forward_m;
  return {in_body.x() + body.left_m * turn_rate, turn_rate};
}

Eigen::Vector2d velocity_towards(const Reference& reference, const Eigen::Matrix2d& K,
                                 const Eigen::Vector2d& y) {
  Eigen::Vector2d velocity = reference.velocity.head<2>() - K * (y - reference.position.head<2>());
  if (velocity.allFinite()) return velocity;
  throw std::invalid_argument("the velocity that is wanted is not finite: look at the estimate and the path");
}

FeedbackLinearization::FeedbackLinearization(const LinearizationSettings& settings)
    : body_(settings.body), limits_(settings.limits) {
  limits_.check();
  if (body_.forward_m == 0 || !std::isfinite(body_.forward_m) || !std::isfinite(body_.left_m)) {
    throw std::invalid_argument(
        "the control point must be before or behind the axle: on its line it cannot move sideways");
  }
  if (const auto why = gain_refusal(settings.gain_per_s, settings.hold_s, limits_.max_turn_rate_rad_s))
    throw *why;
  K_ = settings.gain_per_s;
}

PlanarCommand FeedbackLinearization::act(const planar::Pose<double>& estimate,
                                         const Reference& reference) const {
  const Eigen::Vector2d velocity = velocity_towards(reference, K_, estimate.head<2>());
  return limited(input_for_velocity(body_, estimate[2], velocity), limits_);
}

std::vector<PlanarCommand> act_together(std::span<const FeedbackLinearization> team,
                                        std::span<const planar::Pose<double>> estimates,
                                        std::span<const Reference> references) {
  if (estimates.size() != team.size() || references.size() != team.size()) {
    throw std::invalid_argument(std::to_string(team.size()) + " vehicles, " +
                                std::to_string(estimates.size()) + " estimates and " +
                                std::to_string(references.size()) + " references");
  }
  std::vector<PlanarCommand> commands;
  for (std::size_t i = 0; i < team.size(); ++i) commands.push_back(team[i].act(estimates[i], references[i]));
  return commands;
}

}  // namespace incognita
