// Options that any vehicle may combine: each combination runs over a fixed set of seeds, and the normalized
// estimation error of all poses together (NEES) must be inside its chi-square band.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cstdio>

#include "incognita/app/loop/assembly.hpp"
#include "incognita/app/loop/observability_watch.hpp"
#include "incognita/math/angles.hpp"
#include "incognita/math/gaussian.hpp"
#include "incognita/math/random.hpp"
#include "incognita/slam/estimator/slam_estimator.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

constexpr int seeds = 20;

/// The final errors of all planar vehicles: e' P^-1 e, with the correlations between them.
struct JointError {
  double nees = 0;
  int dof = 0;
  bool lost = false;
  std::size_t landmarks = 0;
};

double joint_nees(const Estimate& e, const Truth& truth) {
  const auto n = static_cast<Eigen::Index>(e.bodies.size());
  Eigen::VectorXd error(3 * n);
  Eigen::MatrixXd P(3 * n, 3 * n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Body& v = e.bodies[static_cast<std::size_t>(i)];
    const SmallVector& x = truth.bodies[static_cast<std::size_t>(i)].state;
    error.segment<3>(3 * i) << x[0] - v.state[0], x[1] - v.state[1], wrap_angle(x[2] - v.state[2]);
    for (Eigen::Index j = 0; j < n; ++j)
      P.block<3, 3>(3 * i, 3 * j) = e.belief.covariance(v.block, e.bodies[static_cast<std::size_t>(j)].block);
    P.block<3, 3>(3 * i, 3 * i) = v.state_covariance;
  }
  return error.dot(P.llt().solve(error));
}

using Change = std::function<void(EstimatorSettings&)>;
using Sense = std::function<void(Observation&, const Truth&, const Tick&)>;

/// Runs a scenario with a modified estimator; `sense` adds measurements that the scenario's own sensor does
/// not make.
JointError run(const std::string& scenario, std::vector<std::string> sets, int seed, const Change& change,
               const Sense& sense = {}) {
  sets.push_back("run.seed=" + std::to_string(seed));
  Assembly assembly = assemble(load_scenario(scenario, sets));
  auto& [clock, world, sensor, scenario_estimator, decision, controller, map_truth] = assembly.parts;
  EstimatorSettings settings = dynamic_cast<SlamEstimator&>(*scenario_estimator).settings();
  change(settings);
  SlamEstimator estimator(settings);
  Estimate estimate;
  Command command;
  JointError out;
  while (const Tick tick = clock->next()) {
    const auto truth = world->move(command, tick);
    Observation observation = sensor->measure(truth, tick);
    if (sense) sense(observation, *truth, tick);
    estimator.update(estimate, command, observation, tick);
    command = controller->act(estimate, decision->choose(estimate, observation, tick), observation, tick);
    out.lost = out.lost || estimate.status.state == TrackingState::lost;
    out.nees = joint_nees(estimate, *truth);
  }
  out.dof = static_cast<int>(3 * estimate.bodies.size());
  out.landmarks = static_cast<std::size_t>(estimate.mapped_count());
  return out;
}

/// The sum over the seeds must be inside the 99.9 % band of its degrees of freedom.
void expect_consistent(const char* name, const std::string& scenario, const std::vector<std::string>& sets,
                       std::size_t landmarks, const Change& change,
                       const std::function<Sense(int seed)>& sense_of = {}) {
  double nees = 0;
  int dof = 0;
  for (int seed = 1; seed <= seeds; ++seed) {
    const JointError one = run(scenario, sets, seed, change, sense_of ? sense_of(seed) : Sense{});
    EXPECT_FALSE(one.lost) << name << ", seed " << seed;
    EXPECT_LE(one.landmarks, landmarks) << name << ", seed " << seed << ": duplicate landmarks";
    nees += one.nees;
    dof += one.dof;
  }
  std::printf("%s: NEES %.2f per degree of freedom (%.2f to %.2f)\n", name, nees / dof,
              chi_square_quantile(0.0005, dof) / dof, chi_square_quantile(0.9995, dof) / dof);
  EXPECT_GT(nees, chi_square_quantile(0.0005, dof)) << name;
  EXPECT_LT(nees, chi_square_quantile(0.9995, dof)) << name;
}

const std::vector<std::string> team_of_three = {"run.duration_s=20",
                                                "start.positions_m=[[-6, 0, 0], [6, 0, 0], [0, 8, 0]]",
                                                "start.headings_rad=[1.5708, -1.5708, 0]",
                                                "path.offsets_m=[[-6, 0, 0], [6, 0, 0], [0, 8, 0]]",
                                                "path.radius_m=4",
                                                "start.sigma_position_m=0.1",
                                                "start.sigma_heading_rad=0.05"};

std::vector<std::string> with(std::vector<std::string> sets, const std::vector<std::string>& more) {
  sets.insert(sets.end(), more.begin(), more.end());
  return sets;
}

TEST(Combinations, JointCompatibilityInATeamOfThree) {
  expect_consistent("joint compatibility, three vehicles", "two-robots",
                    with(team_of_three, {"association.method=joint"}), 16, [](EstimatorSettings& s) {
                      ASSERT_EQ(s.association.method, DataAssociationSettings::Method::joint);
                    });
}

/// Only the first vehicle has a GPS; the others profit through the common landmarks.
TEST(Combinations, PositionFixesOfOneVehicleOfATeam) {
  static constexpr double sigma_m = 0.2;
  const auto fixes = [](int seed) -> Sense {
    const auto noise = std::make_shared<RandomStream>(static_cast<std::uint64_t>(seed), "test: fixes");
    return [noise](Observation& observation, const Truth& truth, const Tick& tick) {
      const Eigen::Vector2d off(noise->normal(), noise->normal());
      const Eigen::Vector2d at = truth.bodies[0].state.head<2>();
      observation.bodies[0].fixes.push_back({tick.t, at + sigma_m * off});
    };
  };
  const auto use_fixes = [](EstimatorSettings& s) { s.bodies[0].sigma_fix_m = sigma_m; };
  expect_consistent("fixes of one vehicle of three", "two-robots", team_of_three, 16, use_fixes, fixes);
  const auto sigma_of_last = [&](const Change& change) {
    Assembly assembly = assemble(load_scenario("two-robots", team_of_three));
    auto& [clock, world, sensor, scenario_estimator, decision, controller, map_truth] = assembly.parts;
    EstimatorSettings settings = dynamic_cast<SlamEstimator&>(*scenario_estimator).settings();
    change(settings);
    SlamEstimator estimator(settings);
    Estimate e;
    Command command;
    const Sense sense = fixes(1);
    while (const Tick tick = clock->next()) {
      const auto truth = world->move(command, tick);
      Observation observation = sensor->measure(truth, tick);
      sense(observation, *truth, tick);
      estimator.update(e, command, observation, tick);
      command = controller->act(e, {}, observation, tick);
    }
    return std::sqrt(e.bodies.back().state_covariance.topLeftCorner(2, 2).trace());
  };
  EXPECT_LT(sigma_of_last(use_fixes), 0.8 * sigma_of_last([](EstimatorSettings&) {}));
}

/// The report at the end of a run of three robots that map together.
ObservabilityReport report_of_three(const std::vector<std::string>& more) {
  Assembly assembly = assemble(load_scenario("two-robots", with(team_of_three, more)));
  ObservabilityWatch watch;
  run_loop(
      assembly.parts, [](const Snapshot&) {}, [](const Tick&) { return true; },
      [&](const Estimate& e) { watch.follow(e); });
  return watch.report().value();
}

/// Without anchors the frame of the whole team is unobservable; two anchors that one of the robots measures fix it for
/// all.
TEST(Combinations, ObservabilityReportOfATeam) {
  const ObservabilityReport free = report_of_three({"points.known=0"});
  EXPECT_EQ(free.uncovered, "");
  EXPECT_EQ(free.ideal_nullity, 3);
  EXPECT_EQ(free.information.errors % 2, 1) << "three poses, and landmarks on the plane";
  EXPECT_GE(free.information.errors, 9 + 2 * 10);
  for (const QuantityReport& q : free.quantities) EXPECT_FALSE(q.ideally_observable) << q.name;
  for (const QuantityReport& q : free.quantities)
    EXPECT_FALSE(q.unit == "m" && q.gained) << q.name << " by measurements of relative positions";

  const ObservabilityReport fixed = report_of_three({"points.known=2"});
  EXPECT_EQ(fixed.anchors, 2);
  EXPECT_EQ(fixed.ideal_nullity, 0);
  EXPECT_EQ(fixed.information.rank, fixed.information.errors);
  for (const QuantityReport& q : fixed.quantities) EXPECT_TRUE(q.ideally_observable && q.gained) << q.name;

  // First-estimate Jacobians add no spurious information: the null space keeps all three directions
  const ObservabilityReport first =
      report_of_three({"points.known=0", "estimator.linearization=first-estimate"});
  EXPECT_EQ(first.spurious_information, 0);
  EXPECT_EQ(first.information.nullity(), 3);
}

TEST(Combinations, ATeamWithTwoAnchorsIsConsistent) {
  expect_consistent("three vehicles, two anchors", "two-robots", with(team_of_three, {"points.known=2"}), 16,
                    [](EstimatorSettings& s) { ASSERT_EQ(s.anchors.size(), 2u); });
}

/// Depths are unknown at first, and the vehicles measure the landmarks of each other from metres beside the rays of their
/// initialization.
TEST(Combinations, ATeamThatMeasuresNoDistances) {
  expect_consistent("three vehicles, bearings only", "two-robots",
                    with(team_of_three, {"points.known=2", "sensor.type=bearing",
                                         "landmark_initialization.inverse_depth_per_m=0.15",
                                         "landmark_initialization.sigma_inverse_depth_per_m=0.1"}),
                    16, [](EstimatorSettings& s) {
                      for (const BodyModel& body : s.bodies)
                        ASSERT_TRUE(std::holds_alternative<BearingSensor>(body.sensors.at(0).sensor));
                    });
}

/// Robots that stand still never learn the depths, and cannot use each other's landmarks: they are not lost for that.
TEST(Combinations, UnknownDepthsAreNoReasonToBeLost) {
  for (int seed = 1; seed <= 4; ++seed) {
    const JointError stood =
        run("two-robots",
            {"run.duration_s=4", "sensor.type=bearing", "landmark_initialization.inverse_depth_per_m=0.15",
             "landmark_initialization.sigma_inverse_depth_per_m=0.1", "sensor.measures_vehicles=false",
             "controller.law=active", "decision.strategy=none", "sensor.max_range_m=40",
             "start.positions_m=[[-3, -3, 0], [3, 3, 0]]", "points.count=5"},
            seed, [](EstimatorSettings&) {});
    EXPECT_FALSE(stood.lost) << seed;
  }
}

TEST(Combinations, AMapInTheFrameOfACarUnderControl) {
  const testing::Scratch folder;
  const std::filesystem::path car = folder.write("car.toml", R"([world]
type = "points"

[sensor]
type = "range-bearing"

[run]
rate_hz = 10
duration_s = 20

[vehicle]
model = "ackermann"
wheelbase_m = 1
wheel_left_m = 0.3
sensor_forward_m = 0.3
sensor_left_m = 0
sigma_speed_m_s = 0.05
sigma_steering_rad = 0.02

[start]
positions_m = [[0, 0, 0]]
sigma_position_m = 0.1
sigma_heading_rad = 0.05

[points]
count = 16
size_m = [30, 30, 0]

[controller]
law = "feedback-linearization"
max_speed_m_s = 1

[path]
type = "circle"
radius_m = 7
)");
  expect_consistent("map in the vehicle's frame, Ackermann car under control", car.string(), {}, 16,
                    [](EstimatorSettings& s) { s.filter.map_frame = MapFrame::vehicle; });
}

}  // namespace
}  // namespace incognita
