// What can be set on the choice of the next move.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "incognita/decision/metric.hpp"

namespace incognita {

struct DecisionSettings {
  enum class Strategy {
    mutual_information,
    random,      ///< any action that is allowed
    fixed_path,  ///< those of `sequence`, again and again
    none         ///< stay where it started
  };
  enum class Schedule {
    every_frame,   ///< all actions in every frame
    at_decisions,  ///< only in those that choose, which chooses the same
    one_per_frame  ///< in random order, as the thesis could
  };
  /// How a free camera turns: to and fro in the rendered room, not at all, steadily to the left; or right,
  /// left or not at all by information: of the state, the trace of (6.8), the same with R for S.
  enum class Gaze { swing, hold, constant_rate, mutual_information, fisher, fisher_given_state };

  Strategy strategy = Strategy::mutual_information;
  Metric metric = Metric::state;
  int horizon = 1;             ///< actions looked ahead; 1: greedy, as the thesis
  int max_evaluations = 1000;  ///< of imagined looks in one comparison
  Schedule schedule = Schedule::every_frame;
  double step_m = 0.3;                   ///< of each of the seven translations, thesis 6.3.1
  std::vector<Eigen::Vector3d> moves_m;  ///< instead: displacements along heading, left, up; one must be 0
  /// Of a vehicle that carries the camera, Table 6.1: accelerations that act for impulse_s once a period
  double acceleration_m_s2 = 0.5;
  double turn_acceleration_rad_s2 = 0.3;
  double impulse_s = 1.0 / 15;                    ///< one frame of the thesis' 15 a second
  std::vector<Eigen::Vector2d> accelerations;     ///< instead: (m/s^2, rad/s^2); one must be 0
  std::string sequence;                           ///< of `fixed-path`: names of actions, with spaces between
  double period_s = 1.0;                          ///< an action lasts this long, then all are compared again
  Eigen::Vector3d min_bound_m{-1e9, -1e9, -1e9};  ///< goals outside this box of the world are not chosen
  Eigen::Vector3d max_bound_m{1e9, 1e9, 1e9};

  Gaze gaze = Gaze::swing;
  double gaze_rate_rad_s = 0.2;  ///< thesis 6.3.1
  double gaze_period_s = 0.05;   ///< a turn lasts so long, then turns are compared again
  double gaze_ahead_s = 1.0;     ///< how long turns are imagined to last
};

/// What is expected where nobody has looked yet: exploration.hpp.
struct ExplorationSettings {
  int expected_landmarks = 0;         ///< in the whole box, mapped or not; 0: nothing unseen is expected
  double variance_expected_m2 = 1.5;  ///< P_uu: of each coordinate of one that is not mapped, thesis 6.3.1
  Eigen::Vector3d min_m{-3, -3, 0};   ///< the box, world
  Eigen::Vector3d max_m{3, 3, 2.5};
  /// Which of those in view count: all, or as many as a camera would map there
  enum class Counted { all, as_mapped };
  Counted counted = Counted::all;
  double cell_m = 0.5;  ///< side of a cell
  double seen_s = 1;    ///< a cell in view for so long, all in all, holds nothing more that is not mapped
};

}  // namespace incognita
