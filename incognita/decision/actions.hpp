// What can be done next.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "incognita/decision/settings.hpp"

namespace incognita {

struct Translation {
  std::string name;
  /// Over one period, m; x along the camera's heading in the horizontal plane, y left, z up
  Eigen::Vector3d displacement_m;
};

/// The seven translations of thesis 6.3.1, of one length each; "stay" is the last.
std::vector<Translation> seven_translations(double step_m);

/// Those of the settings: one's own, else the seven.
std::vector<Translation> translations_of(const DecisionSettings& settings);

/// Translations by what they are: those along an axis have the thesis' names, others their displacement.
std::vector<Translation> named(const std::vector<Eigen::Vector3d>& displacements_m);

/// What an action adds to a vehicle's speed (m/s) and turn rate (rad/s, to the left).
struct SpeedChange {
  std::string name;
  Eigen::Vector2d change;
};

/// Table 6.1, whose order is kept: the mixed pairs (-, +) and (+, -) are absent there. Accelerations act for
/// `impulse_s`.
std::vector<SpeedChange> table_6_1(double acceleration_m_s2, double turn_acceleration_rad_s2,
                                   double impulse_s);

/// Those of the settings: one's own, else Table 6.1.
std::vector<SpeedChange> speed_changes_of(const DecisionSettings& settings);

/// Names of a set of actions, in its order.
template <class Action>
std::vector<std::string> names_of(const std::vector<Action>& actions) {
  std::vector<std::string> names;
  for (const Action& action : actions) names.push_back(action.name);
  return names;
}

/// Changes of (m/s^2, rad/s^2) acting for `impulse_s`, by what they do: "faster_left", "slower", "stay".
std::vector<SpeedChange> named(const std::vector<Eigen::Vector2d>& accelerations, double impulse_s);

}  // namespace incognita
