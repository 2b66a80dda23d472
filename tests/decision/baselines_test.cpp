// The strategies that do not choose by information, with bodies that move exactly as commanded and know where they are.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "incognita/decision/approach.hpp"
#include "incognita/decision/decision.hpp"
#include "incognita/decision/frontier.hpp"
#include "incognita/decision/lawn_mower.hpp"
#include "incognita/math/angles.hpp"
#include "incognita/models/motion/heading.hpp"
#include "incognita/models/sensors/wide_angle_camera.hpp"

namespace incognita {
namespace {

using Strategy = DecisionSettings::Strategy;
using Gaze = DecisionSettings::Gaze;
using Points = std::vector<Eigen::Vector3d>;

constexpr double dt = 0.1;
const Eigen::Vector3d lower(-2.5, -2.5, 0.4), upper(2.5, 2.5, 2.1);

ActiveSettings settings_for(Strategy strategy, Gaze gaze = Gaze::constant_rate) {
  ActiveSettings s;
  s.decision.strategy = strategy;
  s.decision.schedule = DecisionSettings::Schedule::at_decisions;
  s.decision.min_bound_m = lower;
  s.decision.max_bound_m = upper;
  s.decision.gaze = gaze;
  s.exploration.expected_landmarks = 20;
  s.tick_s = dt;
  return s;
}

ActiveSettings driving(Strategy strategy) {
  ActiveSettings s = settings_for(strategy);
  s.decision.impulse_s = 1;
  s.carrier = CarrierSettings{{}, 0.3, 0.3};
  return s;
}

CameraState camera_at(const Eigen::Vector3d& position, double heading_rad, double elevation_rad = 0) {
  CameraState x = CameraState::Zero();
  x.head<3>() = position;
  x.segment<4>(3) = gaze_at(heading_rad, elevation_rad);
  return x;
}

/// A camera, free or carried, that knows where it is and executes its goals exactly, except where `solid` stops it.
struct Explorer {
  EstimatorSettings estimator;
  std::unique_ptr<Decision> decision;
  Eigen::Vector3d position;
  double heading_rad = 0, elevation_rad = 0, t = 0;
  Eigen::Vector2d wheels{0, 0};
  Goal goal;
  Points path;
  int late = 0;                ///< decisions after which a goal is executed, as by an operator
  std::deque<BodyGoal> shown;  ///< the last goals, the newest last
  std::function<bool(const Eigen::Vector3d&)> solid = [](const Eigen::Vector3d&) { return false; };

  explicit Explorer(const ActiveSettings& s, const Eigen::Vector3d& start = {1.6, 0, 1.3}) : position(start) {
    estimator.bodies.push_back(body_with_sensor(
        FreeCameraMotion{}, CameraSensor{Camera(WideAngleCamera{}), {}}, camera_at(start, 0),
        SmallVector::Constant(12, 0.01), SmallVector::Constant(6, 0.01), SmallVector::Constant(2, 1)));
    decision = decide_for(SlamEstimator(estimator), s);
  }

  Estimate estimate() const {
    Estimate e;
    Body& body = e.bodies.emplace_back();
    body.block =
        e.belief.add_vehicle(FreeCameraMotion::chart, camera_at(position, heading_rad, elevation_rad),
                             1e-6 * FreeCameraMotion::Jacobian::Identity());
    body.wheels = wheels;
    e.started = true;
    e.status.state = TrackingState::tracking;
    return e;
  }

  void tick(const Observation& observation = {}) {
    goal = decision->choose(estimate(), observation, Tick{static_cast<std::int64_t>(path.size()), t, dt});
    t += dt;
    const BodyGoal& own = goal.bodies.at(0);
    Eigen::Vector3d to = position;
    if (own.drive) {
      wheels = *own.drive;
      to += wheels[0] * dt * Eigen::Vector3d(std::cos(heading_rad), std::sin(heading_rad), 0);
      heading_rad += wheels[1] * dt;
    } else {
      if (own.decided) shown.push_back(own);
      if (static_cast<int>(shown.size()) > late + 1) shown.pop_front();
      if (static_cast<int>(shown.size()) > late)
        to += dt / (own.end_t - own.start_t) * (shown.front().to - shown.front().from);
      if (own.heading_rad) heading_rad = *own.heading_rad + own.heading_rate_rad_s * dt;
      elevation_rad = own.elevation_rad + own.elevation_rate_rad_s * dt;
    }
    if (!solid(to)) position = to;
    path.push_back(position);
  }
  void run(double duration_s) {
    while (t < duration_s - dt / 2) tick();
  }
};

/// Distance of a point from the nearest one of a path.
double distance_m(const Points& path, const Eigen::Vector3d& point, int axes = 3) {
  double least = 1e9;
  for (const Eigen::Vector3d& p : path) least = std::min(least, (p - point).head(axes).norm());
  return least;
}

void expect_lanes_visited(const Points& path, const Points& lanes, int axes, double within_m) {
  ASSERT_EQ(lanes.size() % 2, 0u);
  for (std::size_t i = 0; i < lanes.size(); i += 2)
    for (double share = 0; share <= 1; share += 0.125)
      EXPECT_LT(distance_m(path, lanes[i] + share * (lanes[i + 1] - lanes[i]), axes), within_m)
          << "lane " << i / 2 << ", " << share << " of it";
}

void expect_inside(const Points& path, int axes, double by_m = 1e-9) {
  for (const Eigen::Vector3d& p : path) {
    ASSERT_LE((p - upper).head(axes).maxCoeff(), by_m) << p.transpose();
    ASSERT_LE((lower - p).head(axes).maxCoeff(), by_m) << p.transpose();
  }
}

TEST(LawnMower, LanesFillTheBoxFromTheNearestCorner) {
  const WorldBounds box{{0, 0, 0}, {4, 3, 2}};
  const Points lanes = lanes_of(box, 1, 3, {3.9, 0.1, 1.9});
  ASSERT_EQ(lanes.size(), 12u) << "three lanes in two layers";
  EXPECT_EQ(lanes[0], Eigen::Vector3d(4, 0.5, 1.5));
  EXPECT_EQ(lanes[1], Eigen::Vector3d(0, 0.5, 1.5)) << "along the longer side";
  EXPECT_EQ(lanes[2], Eigen::Vector3d(0, 1.5, 1.5)) << "the next begins where this ended";
  EXPECT_EQ(lanes[6], Eigen::Vector3d(0, 2.5, 0.5)) << "and the next layer above the end of this one";
  EXPECT_EQ(lanes_of(box, 1, 2, {0, 0, 0}).size(), 6u) << "of a vehicle on the ground";
  EXPECT_EQ(lanes_of(box, 1.5, 3, {0, 0, 0}).size(), 8u) << "as few as the largest width permits";
}

TEST(LawnMower, ACameraVisitsAllLanesWithATurningGaze) {
  ActiveSettings s = settings_for(Strategy::lawn_mower);
  s.decision.lane_m = 1.3;
  Explorer e(s);
  const Points lanes = lanes_of({lower, upper}, 1.3, 3, e.position);
  ASSERT_EQ(lanes.size(), 16u);
  e.run(200);
  expect_lanes_visited(e.path, lanes, 3, 0.4);
  expect_inside(e.path, 3);
}

TEST(LawnMower, AVehicleVisitsAllLanes) {
  Explorer e(driving(Strategy::lawn_mower));
  e.run(150);
  expect_lanes_visited(e.path, lanes_of({lower, upper}, 2, 2, {1.6, 0, 1.3}), 2, 0.6);
  expect_inside(e.path, 2, 0.1);
}

TEST(LawnMower, GoesOnWhereALaneIsBlocked) {
  Explorer e(settings_for(Strategy::lawn_mower));
  e.solid = [](const Eigen::Vector3d& p) { return std::abs(p.x()) < 0.4 && std::abs(p.y()) < 0.6; };
  e.run(120);
  const Points lanes = lanes_of({lower, upper}, 2, 3, {1.6, 0, 1.3});
  for (const Eigen::Vector3d& end : lanes) EXPECT_LT(distance_m(e.path, end), 0.6) << end.transpose();
}

/// It has begun an action only when the next is chosen: that is no obstacle.
TEST(LawnMower, AnOperatorWhoIsLateVisitsAllLanes) {
  ActiveSettings s = settings_for(Strategy::lawn_mower);
  s.delay_s = 1;
  Explorer e(s);
  e.late = 1;
  e.run(120);
  expect_lanes_visited(e.path, lanes_of({lower, upper}, 2, 3, {1.6, 0, 1.3}), 3, 0.6);
}

/// Least and largest distance from the four sides, of a part of a path.
std::pair<double, double> distances_from_sides(const Points& path, std::size_t from) {
  double least = 1e9, most = -1e9;
  for (std::size_t i = from; i < path.size(); ++i) {
    const Eigen::Vector3d& p = path[i];
    const double d = std::min({p.x() - lower.x(), upper.x() - p.x(), p.y() - lower.y(), upper.y() - p.y()});
    least = std::min(least, d);
    most = std::max(most, d);
  }
  return {least, most};
}

/// Rounds about the middle, counterclockwise.
double rounds(const Points& path) {
  double turned = 0;
  for (std::size_t i = 1; i < path.size(); ++i)
    turned += wrap_angle(std::atan2(path[i].y(), path[i].x()) - std::atan2(path[i - 1].y(), path[i - 1].x()));
  return turned / (2 * std::numbers::pi);
}

TEST(WallFollower, ACameraStaysAtItsDistanceAndClosesItsRound) {
  for (const Gaze gaze : {Gaze::hold, Gaze::constant_rate}) {
    Explorer e(settings_for(Strategy::wall_follower, gaze));
    e.run(90);
    EXPECT_GT(rounds(e.path), 1);
    const auto [least, most] = distances_from_sides(e.path, 30);
    EXPECT_GT(least, 0.5 - 0.35) << "about a step";
    EXPECT_LT(most, 0.5 + 0.35) << "where it cuts a corner";
    EXPECT_NEAR(e.path.back().z(), 1.3, 0.16);
  }
}

TEST(WallFollower, AVehicleClosesItsRound) {
  Explorer e(driving(Strategy::wall_follower));
  e.run(90);
  EXPECT_GT(rounds(e.path), 1);
  const auto [least, most] = distances_from_sides(e.path, 100);
  EXPECT_GT(least, 0.2);
  EXPECT_LT(most, 1.2) << "it cuts the corners";
}

TEST(WallFollower, ACameraGoesAroundABoxThatItCannotMeasure) {
  Explorer e(settings_for(Strategy::wall_follower));
  e.solid = [](const Eigen::Vector3d& p) { return p.y() > 1.5 && std::abs(p.x()) < 0.5; };
  e.run(90);
  EXPECT_GT(rounds(e.path), 1.1);
}

double time_to_coverage(Explorer& e, double coverage, double most_s) {
  while (e.t < most_s) {
    e.tick();
    if (*e.goal.coverage >= coverage) return e.t;
  }
  return most_s;
}

/// Share of an empty room that is seen in two minutes.
double seen_by(Strategy strategy, bool drives) {
  Explorer e(drives ? driving(strategy) : settings_for(strategy));
  e.run(120);
  return *e.goal.coverage;
}

TEST(Baselines, SeeAnEmptyRoom) {
  for (const Strategy strategy : {Strategy::lawn_mower, Strategy::wall_follower, Strategy::frontier}) {
    EXPECT_GT(seen_by(strategy, false), 0.98);
    EXPECT_GT(seen_by(strategy, true), strategy == Strategy::wall_follower ? 0.9 : 0.98)
        << "the middle is beside the way along the walls";
  }
  EXPECT_LT(seen_by(Strategy::none, false), 0.9) << "above and below it";
  EXPECT_LT(seen_by(Strategy::none, true), 0.1);
}

/// From several starts, in seconds: the times to see a share of an empty room, by frontiers and at random.
struct Compared {
  double frontier_s = 0, random_s = 0, worst_s = 0;
};
Compared times_to_see(double coverage, bool drives) {
  constexpr int starts = 5;
  Compared mean;
  RandomStream random(7, "starts");
  for (std::uint64_t seed = 1; seed <= starts; ++seed) {
    const Eigen::Vector3d start(random.uniform(-2, 2), random.uniform(-2, 2), 1.2);
    const double heading = random.uniform(-3, 3);
    const auto time_of = [&](Strategy strategy) {
      ActiveSettings s = drives ? driving(strategy) : settings_for(strategy);
      s.seed = seed;
      Explorer e(s, start);
      e.heading_rad = heading;
      const double t = time_to_coverage(e, coverage, 200);
      expect_inside(e.path, drives ? 2 : 3, drives ? 0.1 : 1e-9);
      return t;
    };
    const double frontier_s = time_of(Strategy::frontier);
    mean.frontier_s += frontier_s / starts;
    mean.random_s += time_of(Strategy::random) / starts;
    mean.worst_s = std::max(mean.worst_s, frontier_s);
  }
  return mean;
}

/// The gaze of random motion turns at the same rate.
TEST(Frontier, ACameraSeesAnEmptyRoomSoonerThanAtRandom) {
  const Compared c = times_to_see(0.9, false);
  EXPECT_LT(c.worst_s, 50);
  EXPECT_LT(c.frontier_s, 0.85 * c.random_s);
}

TEST(Frontier, AVehicleSeesAnEmptyRoomSoonerThanAtRandom) {
  const Compared c = times_to_see(0.95, true);
  EXPECT_LT(c.worst_s, 60);
  EXPECT_LT(c.frontier_s, 0.7 * c.random_s);
}

TEST(Frontier, TurnsTheGazeWithinItsRateWhateverTheGazeOfTheSettings) {
  for (const Gaze gaze : {Gaze::swing, Gaze::hold, Gaze::constant_rate}) {
    Explorer e(settings_for(Strategy::frontier, gaze));
    bool left = false, right = false;
    while (e.t < 40) {
      const double before = e.heading_rad;
      e.tick();
      const double turned = e.heading_rad - before;
      EXPECT_LE(std::abs(turned), 0.2 * dt + 1e-9);
      left |= turned > 0.01, right |= turned < -0.01;
    }
    EXPECT_TRUE(left || right);
  }
}

/// The ceiling above it and the floor below are out of view of a level camera.
TEST(Frontier, RaisesAndLowersTheGazeWhereItMay) {
  ActiveSettings s = settings_for(Strategy::frontier);
  s.decision.min_bound_m = {1.5, -0.1, 1.2};
  s.decision.max_bound_m = {1.7, 0.1, 1.4};
  Explorer level(s);
  s.decision.max_elevation_rad = 0.8;
  Explorer free(s);
  level.run(60);
  double highest_rad = 0, lowest_rad = 0;
  while (free.t < 60) {
    const double before_rad = free.elevation_rad;
    free.tick();
    EXPECT_LE(std::abs(free.elevation_rad - before_rad), 0.2 * dt + 1e-9);
    highest_rad = std::max(highest_rad, free.elevation_rad);
    lowest_rad = std::min(lowest_rad, free.elevation_rad);
  }
  EXPECT_GT(*free.goal.coverage, *level.goal.coverage + 0.05);
  EXPECT_GT(highest_rad, 0.3);
  EXPECT_LT(lowest_rad, -0.3);
  EXPECT_LE(std::max(highest_rad, -lowest_rad), 0.8 + 1e-9);
}

TEST(Frontier, StaysWhenEverythingIsSeen) {
  ActiveSettings s = settings_for(Strategy::frontier);
  s.exploration.min_m = {1, -1, 1};
  s.exploration.max_m = {3, 1, 2};
  Explorer e(s);
  ASSERT_LT(time_to_coverage(e, 1, 60), 60);
  e.run(e.t + 2);
  const Eigen::Vector3d there = e.position;
  const double heading = e.heading_rad;
  e.run(e.t + 5);
  EXPECT_EQ(e.position, there);
  EXPECT_NEAR(e.heading_rad, heading, 0.2);
}

TEST(Frontier, GivesUpCellsThatItCannotSee) {
  ActiveSettings s = settings_for(Strategy::frontier);
  s.decision.min_bound_m = {1.5, -0.1, 1.2};  // the cells above and below it stay out of view
  s.decision.max_bound_m = {1.7, 0.1, 1.4};
  Explorer e(s);
  e.run(60);
  EXPECT_GT(*e.goal.coverage, 0.5) << "it turns to the others";
  EXPECT_LT(*e.goal.coverage, 1);
}

TEST(Frontier, CellsAreUnseenAndBesideSeenOnes) {
  ExplorationVolume v{{0, 0, 0}, {3, 2, 1}, 1, {3, 2, 1}, {0}};
  EXPECT_EQ(frontier_cells(v), (std::vector<int>{0, 1, 2, 3, 4, 5})) << "nothing is seen yet";
  v.seen[0] = 0b000001;
  EXPECT_EQ(frontier_cells(v), (std::vector<int>{1, 3}));
  v.seen[0] = 0b111110;
  EXPECT_EQ(frontier_cells(v), (std::vector<int>{0}));
  v.seen[0] = 0b111111;
  EXPECT_TRUE(frontier_cells(v).empty());
}

/// A vehicle that drives at 0.3 m/s towards something at 0.8 m, and could turn or go on.
TEST(Approach, AVehicleTurnsAwayFromWhatItsSensorsRead) {
  Mobility can;
  can.axes = 2;
  can.drives = true;
  can.turn_rate_rad_s = 0.3;
  can.clearance_m = 0.7;
  can.arrives = false;
  const SpeedChanges changes(table_6_1(0.5, 0.3, 1), 1, growth_over(1, 1, 1), {}, {}, 0.3, 0.3);
  BlockVector state(15);
  state << camera_at({0, 0, 1}, 0), 0.3, 0;
  const std::vector<bool> allowed(7, true);
  const auto chosen = [&](const std::vector<ConeRange>& ranges) {
    Approach approach(can);
    Surroundings around;
    around.obstacles = ranges;
    const RuleInput now{state, changes, around, 0};
    approach.update(now);
    const Eigen::Vector3d to(3, 0, 0);
    return changes
        .actions()[static_cast<std::size_t>(
            approach.choose(now, allowed, [&](const BlockVector& x) { return approach.time_to_s(x, to); }))]
        .name;
  };
  EXPECT_EQ(chosen({}), "stay");
  EXPECT_EQ(chosen({{0, 0.1, 4}}), "stay") << "far away";
  EXPECT_NE(chosen({{0, 0.1, 0.8}, {0.2, 0.1, 0.8}}), "stay");
}

TEST(Approach, RemembersWhereItWasStopped) {
  const Translations steps(seven_translations(0.3), 1, growth_over(1, 0.3, 0.3), {});
  const std::vector<bool> allowed(7, true);
  Approach approach(Mobility{});
  const Eigen::Vector3d to(1, 0, 0);
  const BlockVector state = camera_at({0, 0, 0}, 0);
  const RuleInput now{state, steps, {}, 0};
  const auto choose = [&] {
    const auto action =
        approach.choose(now, allowed, [&](const BlockVector& x) { return approach.time_to_s(x, to); });
    return steps.actions()[static_cast<std::size_t>(action)].name;
  };
  approach.update(now);
  EXPECT_EQ(choose(), "go_forward");
  EXPECT_TRUE(approach.is_clear({0.3, 0, 0}));
  approach.update(now);  // it is where it was
  EXPECT_FALSE(approach.is_clear({0.3, 0, 0}));
  EXPECT_GT((approach.clear_point({0.4, 0, 0}, {0.4, 3, 0}) - Eigen::Vector3d(0.3, 0, 0)).norm(), 0.299);
  const std::string around = choose();
  EXPECT_TRUE(around == "go_left" || around == "go_right") << around;
  bool again = false;
  for (int i = 0; i < 10 && !again; ++i) {
    approach.update(now);
    again = choose() == "go_forward";
  }
  EXPECT_TRUE(again) << "where it is stopped everywhere, the estimate may be wrong";
}

TEST(Baselines, RefuseWhereTheyCannotWork) {
  const auto refused = [](const ActiveSettings& s) { EXPECT_THROW(Explorer{s}, std::invalid_argument); };
  ActiveSettings s = settings_for(Strategy::wall_follower);
  s.decision.wall_distance_m = 2.5;
  refused(s);
  for (const Strategy strategy : {Strategy::lawn_mower, Strategy::wall_follower}) {
    s = settings_for(strategy);
    s.decision.min_bound_m = DecisionSettings{}.min_bound_m;
    refused(s);
  }
  s = settings_for(Strategy::lawn_mower);
  s.decision.lane_m = 1e-4;
  refused(s);
  s = settings_for(Strategy::frontier);
  s.exploration.expected_landmarks = 0;
  refused(s);
  s.exploration.expected_landmarks = 20;
  s.decision.gaze_rate_rad_s = 0;
  refused(s);
  s = settings_for(Strategy::lawn_mower);
  s.decision.moves_m = {{0, 0, 0}};
  refused(s);
}

TEST(Baselines, OfVehiclesWithoutACamera) {
  const auto decide = [](const AnyMotion& motion, const SmallVector& start, Strategy strategy) {
    EstimatorSettings estimator;
    const auto errors = start.size();
    estimator.bodies.push_back(
        body_with_sensor(motion, RangeBearingSensor{}, start, SmallVector::Constant(errors, 0.1),
                         SmallVector::Constant(inputs_of(motion), 0.05), Eigen::Vector2d(0.1, 0.02)));
    decide_for(SlamEstimator(estimator), settings_for(strategy));
  };
  const SmallVector start = Eigen::Vector3d::Zero();
  EXPECT_NO_THROW(decide(DifferentialDrive{}, start, Strategy::lawn_mower));
  EXPECT_NO_THROW(decide(DifferentialDrive{}, start, Strategy::wall_follower));
  EXPECT_THROW(decide(DifferentialDrive{}, start, Strategy::frontier), std::invalid_argument);
}

}  // namespace
}  // namespace incognita
