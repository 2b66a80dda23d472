// Settings of the decision.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "incognita/decision/metric.hpp"
#include "incognita/math/setting.hpp"

namespace incognita {

struct DecisionSettings {
  enum class Strategy {
    mutual_information,
    random,         ///< any allowed action
    fixed_path,     ///< the actions of `sequence`, cyclically
    lawn_mower,     ///< parallel lanes through the bounds
    wall_follower,  ///< around along the sides of the bounds
    plan,      ///< motion and gaze together, one or several actions ahead, for pose and map to a resolution
    frontier,  ///< to where the nearest unseen cells come into view
    none       ///< always "stay"
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
  int horizon = 1;
  int max_evaluations = 1000;
  int held_periods = 2;
  int views_per_period = 2;
  double resolution_m = 0.05;
  int min_matches = 8;
  double pose_weight = 1;
  double discount_s = 10;
  double prepare_s = 0.5;
  Schedule schedule = Schedule::every_frame;
  double step_m = 0.3;
  std::vector<Eigen::Vector3d> moves_m;
  double acceleration_m_s2 = 0.5;
  double turn_acceleration_rad_s2 = 0.3;
  double impulse_s = 1.0 / 15;  // one frame at the thesis' 15 Hz
  std::vector<Eigen::Vector2d> accelerations;
  std::string sequence;
  double lane_m = 2;
  double wall_distance_m = 0.5;
  double period_s = 1.0;
  Eigen::Vector3d min_bound_m{-1e9, -1e9, -1e9};
  Eigen::Vector3d max_bound_m{1e9, 1e9, 1e9};

  Gaze gaze = Gaze::swing;
  double gaze_rate_rad_s = 0.2;
  double max_elevation_rad = 0;
  double gaze_period_s = 0.05;
  double gaze_ahead_s = 1.0;

  /// Whether the bounds in x and y are given: those of the defaults are farther apart than any place.
  bool has_sides() const { return (max_bound_m - min_bound_m).head<2>().maxCoeff() < 1e6; }

  static void describe(auto&& setting) {
    using namespace limits;
    using S = DecisionSettings;
    setting(&S::strategy, "strategy", "", any(), "Choice of the next action; `none`: no motion");
    setting(&S::metric, "metric", "", any(),
            "State whose entropy is compared: all, without gaze and velocities, or the vehicle alone");
    setting(&S::horizon, "horizon", "", between(1, 20), "Number of actions planned ahead; 1: greedy");
    setting(
        &S::max_evaluations, "max_evaluations", "", between(1, 10000000),
        "Limit of the sets of predicted measurements in one comparison; with the strategy `plan`, of imagined actions");
    setting(&S::held_periods, "held_periods", "", between(1, 100),
            "Periods for which the strategy `plan` holds each action after the first");
    setting(&S::views_per_period, "views_per_period", "", between(1, 100),
            "Views per action in which the strategy `plan` expects measurements");
    setting(&S::resolution_m, "resolution_m", "m", above_up_to(0, 1e3),
            "Accuracy that the strategy `plan` aims at: information beyond it is worth nothing");
    setting(&S::min_matches, "min_matches", "", between(0, 10000),
            "Landmarks of the map that must be expected in every view of a plan");
    setting(&S::pose_weight, "pose_weight", "", between(0, 1e3),
            "Weight of the information about the pose beside that about the landmarks in a plan");
    setting(
        &S::prepare_s, "prepare_s", "s", between(0, 1e4),
        "Last part of an action in which the strategy `plan` prepares the next choice, a few candidates per frame; 0: all "
        "at once when it is due");
    setting(
        &S::discount_s, "discount_s", "s", between(0, 1e4),
        "Time after a plan in which the worth of what is still to be mapped falls to 1/e; 0: it is worth nothing");
    setting(&S::schedule, "schedule", "", any(),
            "Frames in which actions are scored: every one, those of a decision, or one action per frame");
    setting(&S::sequence, "sequence", "", any(),
            "Names of the actions that the strategy `fixed-path` repeats, separated by spaces");
    setting(&S::lane_m, "lane_m", "m", above_up_to(0, 1e6),
            "Largest width and height of a lane of the strategy `lawn-mower`");
    setting(&S::wall_distance_m, "wall_distance_m", "m", between(0, 1e6),
            "Distance of the strategy `wall-follower` from the sides of the bounds");
    setting(&S::period_s, "period_s", "s", between(0.001, 1e4),
            "Duration of an action, after which all are compared again");
    setting(&S::min_bound_m, "min_bound_m", "m", any(), "Lower corner of the box that goals must lie in");
    setting(&S::max_bound_m, "max_bound_m", "m", any(), "Upper corner of the box that goals must lie in");
    setting(&S::step_m, "step_m", "m", above_up_to(0, 1000),
            "Length of each of the seven translations, thesis 6.3.1");
    setting(&S::moves_m, "displacements_m", "m", between(-1000, 1000),
            "Displacements along heading, left and up in place of the seven translations; one must be 0");
    setting(&S::acceleration_m_s2, "acceleration_m_s2", "m/s^2", above_up_to(0, 1000),
            "Acceleration of the vehicle in the actions of Table 6.1");
    setting(&S::turn_acceleration_rad_s2, "turn_acceleration_rad_s2", "rad/s^2", above_up_to(0, 1000),
            "Angular acceleration of the vehicle in the actions of Table 6.1");
    setting(&S::impulse_s, "impulse_s", "s", above_up_to(0, 1000),
            "Time for which an action accelerates, once per period");
    setting(&S::accelerations, "accelerations", "", between(-1000, 1000),
            "Actions in place of Table 6.1, [m/s^2, rad/s^2] each; one must be 0");
    setting(
        &S::gaze, "gaze", "", any(),
        "Rotation of a free camera; not used with the strategies `frontier` and `plan`, which turn it themselves");
    setting(&S::gaze_rate_rad_s, "gaze_rate_rad_s", "rad/s", between(0, 10),
            "Angular rate of the gaze, thesis 6.3.1");
    setting(
        &S::max_elevation_rad, "max_elevation_rad", "rad", between(0, 1.5),
        "Largest elevation of the gaze above and below the horizon, between which it rises and falls at gaze_rate_rad_s where "
        "no plan chooses it; 0: level, as in the thesis");
    setting(&S::gaze_period_s, "gaze_period_s", "s", between(0.001, 1e4),
            "Duration of a rotation, after which rotations are compared again");
    setting(&S::gaze_ahead_s, "gaze_ahead_s", "s", between(0.001, 1e4),
            "Predicted duration of a rotation in a comparison");
  }
};

/// Exploration prior: see exploration.hpp.
struct ExplorationSettings {
  /// Which of the unmapped landmarks in view count: all, or as many as a camera would initialize there
  enum class Counted { all, as_mapped };
  enum class Placed {
    in_volume,  ///< at random in unseen cells
    on_sides    ///< on the walls, the floor and the ceiling
  };

  int expected_landmarks = 0;
  double variance_expected_m2 = 1.5;
  Eigen::Vector3d min_m{-3, -3, 0};
  Eigen::Vector3d max_m{3, 3, 2.5};
  Counted counted = Counted::all;
  Placed placed = Placed::in_volume;
  double side_cell_m = 1;
  double patience_s = 3;
  double cell_m = 0.5;
  double seen_s = 1;

  static void describe(auto&& setting) {
    using namespace limits;
    using S = ExplorationSettings;
    setting(&S::expected_landmarks, "expected_landmarks", "", between(0, 1000),
            "Number of landmarks in the whole exploration volume, mapped or not; 0: no exploration prior");
    setting(&S::variance_expected_m2, "variance_expected_m2", "m^2", above_up_to(0, 1e6),
            "Variance of each coordinate of an unmapped landmark, P_uu, thesis 6.3.1");
    setting(&S::counted, "counted", "", any(),
            "Unmapped landmarks in view that count: all, or as many as map.wanted_visible would initialize");
    setting(&S::placed, "placed", "", any(), "Where unmapped landmarks are expected");
    setting(&S::side_cell_m, "side_cell_m", "m", above_up_to(0, 1000),
            "Side of the cells of the walls, floor and ceiling, each of which holds one landmark");
    setting(
        &S::patience_s, "patience_s", "s", above_up_to(0, 1e4),
        "Time in view without a landmark in which the probability that such a cell holds one falls to 1/e");
    setting(&S::min_m, "volume_min_m", "m", any(), "Lower corner of the exploration volume");
    setting(&S::max_m, "volume_max_m", "m", any(), "Upper corner of the exploration volume");
    setting(&S::cell_m, "cell_m", "m", above_up_to(0, 1000), "Side of a cell of the exploration volume");
    setting(&S::seen_s, "seen_s", "s", above_up_to(0, 1e4),
            "Time in view after which a cell holds no unmapped landmarks");
  }
};

}  // namespace incognita
