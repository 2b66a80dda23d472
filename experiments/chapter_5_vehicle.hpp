// The vehicle of closed_loop_run.hpp with its state known and without noise, along exact arcs.
#pragma once

#include <functional>
#include <vector>

#include "experiments/closed_loop_run.hpp"
#include "incognita/control/planar_command.hpp"
#include "incognita/models/motion/arc_motion.hpp"

namespace incognita::closed_loop {

using Pose = planar::Pose<double>;

inline constexpr PlanarLimits body_limits{top_speed_m_s, top_turn_rate};

/// The pose after an input that was held.
inline Pose moved(const Pose& pose, const Eigen::Vector2d& input, double hold_s = period_s,
                  const DifferentialDrive& vehicle = body) {
  return ArcMotion<DifferentialDrive>{vehicle}.f<double>(pose, input, hold_s);
}

/// From tick to tick.
struct Way {
  std::vector<Pose> poses;
  std::vector<Eigen::Vector2d> inputs;  ///< that each pose was left with

  double distance_m(const Path& path, std::size_t tick) const {
    return (poses[tick].head<2>() - at(path, period_s * static_cast<double>(tick)).position.head<2>()).norm();
  }
  std::vector<double> distances_m(const Path& path, std::size_t from_tick = 0) const {
    std::vector<double> distances;
    for (std::size_t k = from_tick; k < poses.size(); ++k) distances.push_back(distance_m(path, k));
    return distances;
  }
};

/// Speed and turn rate, by the pose and the time.
using Law = std::function<Eigen::Vector2d(const Pose&, double)>;

/// Where the law leads within the limits.
inline Way steer(const Law& law, Pose pose, double duration_s, const DifferentialDrive& vehicle = body) {
  Way way;
  const auto ticks = std::lround(duration_s / period_s);
  for (long k = 0; k < ticks; ++k) {
    way.poses.push_back(pose);
    way.inputs.push_back(limited(law(pose, period_s * static_cast<double>(k)), body_limits).input());
    pose = moved(pose, way.inputs.back(), period_s, vehicle);
  }
  return way;
}

/// Two rounds of a circle at 5 deg/s, and the tick at which the second begins.
inline constexpr double two_rounds_s = 144;
inline constexpr std::size_t second_round = 720;

}  // namespace incognita::closed_loop
