#include "incognita/decision/plan/moves.hpp"

#include <Eigen/Geometry>
#include <utility>

#include "incognita/models/motion/heading.hpp"

namespace incognita {

JointMoves::JointMoves(std::vector<Translation> translations, double period_s, double gaze_rate_rad_s,
                       const WorldBounds& bounds)
    : translations_(std::move(translations)),
      period_s_(period_s),
      gaze_rate_rad_s_(gaze_rate_rad_s),
      bounds_(bounds),
      stay_(find_stay(translations_)) {}

double JointMoves::rate_of(int move) const {
  const int turn = move % turns;
  return turn == 0 ? 0 : turn == 1 ? gaze_rate_rad_s_ : -gaze_rate_rad_s_;
}

std::vector<std::string> JointMoves::names() const {
  std::vector<std::string> names;
  for (const Translation& t : translations_)
    for (const char* turn : {"", "_turning_left", "_turning_right"}) names.push_back(t.name + turn);
  return names;
}

BlockVector JointMoves::along(const BlockVector& state, int move, double s) const {
  BlockVector out = state;
  const Eigen::Vector4d gaze = state.segment<4>(3);
  const Eigen::AngleAxisd heading(heading_of(gaze), Eigen::Vector3d::UnitZ());
  const Translation& translation = translations_[static_cast<std::size_t>(move / turns)];
  out.head<3>() += s / period_s_ * (heading * translation.displacement_m);
  out.segment<4>(3) = turned_left(gaze, rate_of(move) * s);
  out.tail<6>().setZero();
  return out;
}

double JointMoves::outside_m(const BlockVector& state) const { return bounds_.outside_m(state.head<3>()); }

}  // namespace incognita
