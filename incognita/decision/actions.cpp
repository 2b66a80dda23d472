#include "incognita/decision/actions.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace incognita {
namespace {

std::string name_of(const Eigen::Vector3d& d) {
  constexpr const char* ways[3][2] = {
      {"go_backwards", "go_forward"}, {"go_right", "go_left"}, {"go_down", "go_up"}};
  if (d.isZero()) return "stay";
  for (int axis = 0; axis < 3; ++axis)
    if (std::abs(d[axis]) == d.norm()) return ways[axis][d[axis] > 0];
  std::ostringstream name;
  name << std::showpos << "go_" << d.x() << "_" << d.y() << "_" << d.z();
  return name.str();
}

std::string name_of(const Eigen::Vector2d& change) {
  if (change.isZero()) return "stay";
  std::string name = change.x() > 0 ? "faster" : change.x() < 0 ? "slower" : "";
  if (change.y() != 0) name += std::string(name.empty() ? "" : "_") + (change.y() > 0 ? "left" : "right");
  return name;
}

/// Appends a number to actions of the same name, e.g. of different lengths.
template <class Action>
void number_doubles(std::vector<Action>& actions) {
  for (std::size_t i = 0; i < actions.size(); ++i) {
    int same = 1;
    for (std::size_t j = i + 1; j < actions.size(); ++j)
      if (actions[j].name == actions[i].name) actions[j].name += "_" + std::to_string(++same);
  }
}

}  // namespace

std::vector<Translation> seven_translations(double step_m) {
  std::vector<Eigen::Vector3d> all;
  for (const Eigen::Vector3d& way :
       {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(-1, 0, 0), Eigen::Vector3d(0, -1, 0),
        Eigen::Vector3d(0, 1, 0), Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(0, 0, -1),
        Eigen::Vector3d(0, 0, 0)})
    all.push_back(step_m * way);
  return named(all);
}

std::vector<Translation> translations_of(const DecisionSettings& s) {
  return s.moves_m.empty() ? seven_translations(s.step_m) : named(s.moves_m);
}

double longest_m(const std::vector<Translation>& actions) {
  double longest = 0;
  for (const Translation& action : actions) longest = std::max(longest, action.displacement_m.norm());
  return longest;
}

std::vector<Translation> named(const std::vector<Eigen::Vector3d>& displacements_m) {
  std::vector<Translation> actions;
  for (const Eigen::Vector3d& d : displacements_m) actions.push_back({name_of(d), d});
  number_doubles(actions);
  return actions;
}

std::vector<SpeedChange> table_6_1(double acceleration_m_s2, double turn_acceleration_rad_s2,
                                   double impulse_s) {
  const double v = acceleration_m_s2, w = turn_acceleration_rad_s2;
  return named(std::vector<Eigen::Vector2d>{{0, 0}, {0, -w}, {0, w}, {-v, 0}, {v, 0}, {-v, -w}, {v, w}},
               impulse_s);
}

std::vector<SpeedChange> speed_changes_of(const DecisionSettings& s) {
  if (s.accelerations.empty()) return table_6_1(s.acceleration_m_s2, s.turn_acceleration_rad_s2, s.impulse_s);
  return named(s.accelerations, s.impulse_s);
}

std::vector<SpeedChange> named(const std::vector<Eigen::Vector2d>& accelerations, double impulse_s) {
  std::vector<SpeedChange> actions;
  for (const Eigen::Vector2d& a : accelerations) actions.push_back({name_of(a), a * impulse_s});
  number_doubles(actions);
  return actions;
}

}  // namespace incognita
