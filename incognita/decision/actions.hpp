// The actions of the decision: translations, and changes of speed.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "incognita/decision/settings.hpp"

namespace incognita {

struct Translation {
  std::string name;
  /// Displacement over one period, m; x along the camera's heading in the horizontal plane, y left, z up.
  Eigen::Vector3d displacement_m;
};

/// The seven translations of thesis 6.3.1, each of length `step_m`; "stay" is the last.
std::vector<Translation> seven_translations(double step_m);

/// The translations of the settings; the seven of the thesis if the settings list none.
std::vector<Translation> translations_of(const DecisionSettings& settings);

/// Length of the longest, m.
double longest_m(const std::vector<Translation>& actions);

/// Names translations by their direction: those along an axis get the thesis' names, others their displacement.
std::vector<Translation> named(const std::vector<Eigen::Vector3d>& displacements_m);

/// Change of a vehicle's speed (m/s) and turn rate (rad/s, positive to the left).
struct SpeedChange {
  std::string name;
  Eigen::Vector2d change;
};

/// Table 6.1, in its order, which lacks the mixed pairs (-, +) and (+, -). Accelerations act for `impulse_s`.
std::vector<SpeedChange> table_6_1(double acceleration_m_s2, double turn_acceleration_rad_s2,
                                   double impulse_s);

/// The speed changes of the settings; Table 6.1 if the settings list none.
std::vector<SpeedChange> speed_changes_of(const DecisionSettings& settings);

/// Names of the actions, in their order.
template <class Action>
std::vector<std::string> names_of(const std::vector<Action>& actions) {
  std::vector<std::string> names;
  for (const Action& action : actions) names.push_back(action.name);
  return names;
}

/// Names the changes due to accelerations (m/s^2, rad/s^2) over `impulse_s`: "faster_left", "slower", "stay".
std::vector<SpeedChange> named(const std::vector<Eigen::Vector2d>& accelerations, double impulse_s);

}  // namespace incognita
