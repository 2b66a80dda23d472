#include "incognita/decision/action_rule.hpp"

#include <stdexcept>

#include "incognita/decision/frontier.hpp"
#include "incognita/decision/lawn_mower.hpp"
#include "incognita/decision/wall_follower.hpp"

namespace incognita {
namespace {

std::unique_ptr<ActionRule> rule_of(const DecisionSettings& s, const Mobility& mobility) {
  switch (s.strategy) {
    case DecisionSettings::Strategy::lawn_mower:
      return lawn_mower(s, mobility);
    case DecisionSettings::Strategy::wall_follower:
      return wall_follower(s, mobility);
    case DecisionSettings::Strategy::frontier:
      return std::make_unique<Frontier>(s, mobility);
    case DecisionSettings::Strategy::mutual_information:
    case DecisionSettings::Strategy::plan:
    case DecisionSettings::Strategy::random:
    case DecisionSettings::Strategy::fixed_path:
    case DecisionSettings::Strategy::none:
      break;
  }
  return nullptr;
}

}  // namespace

Eigen::Vector3d position_in(const BlockVector& state, const Mobility& mobility) {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  position.head(mobility.axes) = state.head(mobility.axes);
  return position;
}

std::unique_ptr<ActionRule> make_rule(const DecisionSettings& s, const Mobility& mobility) {
  std::unique_ptr<ActionRule> rule = rule_of(s, mobility);
  if (rule && mobility.axes < 2)
    throw std::invalid_argument(
        "decision.strategy: must be `mutual-information`, `random`, `fixed-path` or `none` for a vehicle on a "
        "line");
  if (rule && !(mobility.step_m > 0))
    throw std::invalid_argument(
        "decision.displacements_m: must have one that is not [0, 0, 0], unless decision.strategy is `none`");
  return rule;
}

}  // namespace incognita
