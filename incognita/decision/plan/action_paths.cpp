#include "incognita/decision/plan/action_paths.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <utility>

#include "incognita/models/motion/heading.hpp"

namespace incognita {

JointActions::JointActions(std::vector<Translation> translations, double period_s, double gaze_rate_rad_s,
                           double max_elevation_rad, const WorldBounds& bounds)
    : translations_(std::move(translations)),
      period_s_(period_s),
      gaze_rate_rad_s_(gaze_rate_rad_s),
      max_elevation_rad_(max_elevation_rad),
      bounds_(bounds),
      stay_(find_stay(translations_)),
      turns_(max_elevation_rad > 0 ? 9 : 3) {}

namespace {

/// To the left and up; the first three are level.
struct Turn {
  int left, up;
  const char* suffix;
};
constexpr std::array<Turn, 9> all_turns{{{0, 0, ""},
                                         {1, 0, "_turning_left"},
                                         {-1, 0, "_turning_right"},
                                         {0, 1, "_turning_up"},
                                         {0, -1, "_turning_down"},
                                         {1, 1, "_turning_left_up"},
                                         {1, -1, "_turning_left_down"},
                                         {-1, 1, "_turning_right_up"},
                                         {-1, -1, "_turning_right_down"}}};

}  // namespace

Eigen::Vector2d JointActions::rates_of(int action) const {
  const Turn& turn = all_turns[static_cast<std::size_t>(action % turns_)];
  return gaze_rate_rad_s_ * Eigen::Vector2d(turn.left, turn.up);
}

std::vector<std::string> JointActions::names() const {
  std::vector<std::string> names;
  for (const Translation& t : translations_)
    for (int turn = 0; turn < turns_; ++turn)
      names.push_back(t.name + all_turns[static_cast<std::size_t>(turn)].suffix);
  return names;
}

BlockVector JointActions::along(const BlockVector& state, int action, double s) const {
  BlockVector out = state;
  const Eigen::Vector4d gaze = state.segment<4>(3);
  const double heading_rad = heading_of(gaze);
  const Eigen::AngleAxisd heading(heading_rad, Eigen::Vector3d::UnitZ());
  const Translation& translation = translations_[static_cast<std::size_t>(action / turns_)];
  out.head<3>() += s / period_s_ * (heading * translation.displacement_m);
  const Eigen::Vector2d turned = s * rates_of(action);
  out.segment<4>(3) = gaze_at(heading_rad + turned.x(), std::clamp(elevation_of(gaze) + turned.y(),
                                                                   -max_elevation_rad_, max_elevation_rad_));
  out.tail<6>().setZero();
  return out;
}

double JointActions::outside_m(const BlockVector& state) const { return bounds_.outside_m(state.head<3>()); }

}  // namespace incognita
