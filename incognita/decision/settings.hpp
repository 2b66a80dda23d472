// Settings of the decision.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "incognita/decision/metric.hpp"

namespace incognita {

struct DecisionSettings {
  enum class Strategy {
    mutual_information,
    random,      ///< any allowed action
    fixed_path,  ///< the actions of `sequence`, cyclically
    none         ///< always "stay"
  };
  enum class Schedule {
    every_frame,   ///< scores all actions in every frame
    at_decisions,  ///< scores only when choosing; the choices are the same
    one_per_frame  ///< scores one action per frame in random order, as in the thesis
  };
  /// Gaze of a free camera. `swing`: to and fro in the rendered room; `hold`: fixed; `constant_rate`:
  /// steadily to the left; else right, left or fixed, chosen by mutual information, by the trace of (6.8), or
  /// by the same with R for S.
  enum class Gaze { swing, hold, constant_rate, mutual_information, fisher, fisher_given_state };

  Strategy strategy = Strategy::mutual_information;
  Metric metric = Metric::state;
  int horizon = 1;             ///< actions planned ahead; 1: greedy, as in the thesis
  int max_evaluations = 1000;  ///< sets of predicted measurements per comparison
  Schedule schedule = Schedule::every_frame;
  double step_m = 0.3;  ///< length of each of the seven translations, thesis 6.3.1
  /// Overrides step_m: displacements along heading, left, up; one must be 0.
  std::vector<Eigen::Vector3d> moves_m;
  /// Speed changes of a vehicle that carries the camera, Table 6.1: accelerations act for impulse_s once per period
  double acceleration_m_s2 = 0.5;
  double turn_acceleration_rad_s2 = 0.3;
  double impulse_s = 1.0 / 15;                 ///< one frame at the thesis' 15 Hz
  std::vector<Eigen::Vector2d> accelerations;  ///< overrides Table 6.1: (m/s^2, rad/s^2); one must be 0
  std::string sequence;                        ///< `fixed-path` only: names of actions, separated by spaces
  double period_s = 1.0;                       ///< duration of an action; then all are compared again
  Eigen::Vector3d min_bound_m{-1e9, -1e9, -1e9};  ///< goals outside these world bounds are not chosen
  Eigen::Vector3d max_bound_m{1e9, 1e9, 1e9};

  Gaze gaze = Gaze::swing;
  double gaze_rate_rad_s = 0.2;  ///< thesis 6.3.1
  double gaze_period_s = 0.05;   ///< duration of a turn; then turns are compared again
  double gaze_ahead_s = 1.0;     ///< predicted duration of a turn when comparing
};

/// Exploration prior: see exploration.hpp.
struct ExplorationSettings {
  int expected_landmarks = 0;         ///< in the whole volume, mapped or not; 0: no prior
  double variance_expected_m2 = 1.5;  ///< P_uu: per coordinate of an unmapped landmark, thesis 6.3.1
  Eigen::Vector3d min_m{-3, -3, 0};   ///< exploration volume, world
  Eigen::Vector3d max_m{3, 3, 2.5};
  /// Which of the unmapped landmarks in view count: all, or as many as a camera would initialize there
  enum class Counted { all, as_mapped };
  Counted counted = Counted::all;
  double cell_m = 0.5;  ///< side length of a cell
  double seen_s = 1;    ///< total time in view after which a cell holds no unmapped landmarks
};

}  // namespace incognita
