// Runs of scenarios of point landmarks: association, carried cameras, operators and tables.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "incognita/app/loop/association_score.hpp"
#include "incognita/math/random.hpp"
#include "tests/app/point_scenario.hpp"

namespace incognita {
namespace {

using namespace testing;

TEST(PointScenarioRun, ACarriedCameraFollowsItsCommandsAndIsLocalized) {
  const Ran held = run(load(carried + "[controller]\nlaw = \"none\"\ninput = [0.2, 0.1]\n"));
  const SnapshotBody& v = held.last.bodies.front();
  EXPECT_NEAR(v.truth->position.head<2>().norm(), 0.8, 0.25)
      << "4 s at 0.2 m/s, by a camera 0.6 m over ground that tilts it";
  EXPECT_LT((v.truth->position - v.estimate.position).norm(), 0.2);
  EXPECT_EQ(v.input.size(), 2);
  const Ran active = run(load(carried + "[controller]\nlaw = \"active\"\n"));
  EXPECT_EQ(active.last.bodies.at(0).decision.actions.size(), 7u);
  EXPECT_EQ(active.last.bodies.at(0).decision.actions[3], "slower");
  EXPECT_GE(active.last.bodies.at(0).decision.chosen, 0);
}

/// The filter has no input: it does not know how the operator moves the camera.
TEST(PointScenarioRun, AnOperatorMovesTheCamera) {
  const std::string operator_controlled =
      "[world]\ntype = \"points\"\n[sensor]\ntype = \"camera\"\n[run]\nrate_hz = 15\n"
      "duration_s = 4\n[vehicle]\nmodel = \"free-camera\"\nsigma_acceleration_m_s2 = 2\n"
      "[camera]\nkd1_per_px2 = 9e-6\n[start]\npositions_m = [[-1.5, 0, 1.2]]\n[points]\n"
      "count = 31\nsize_m = [6, 6, 2.5]\nknown = 6\n[controller]\nlaw = \"active\"\n"
      "[decision]\ngaze = \"hold\"\n";
  const Ran actuator = run(load(operator_controlled, {"operator.holds=true", "operator.delay_s=0.5"}));
  const Ran robot = run(load(operator_controlled));
  EXPECT_TRUE(actuator.last.bodies[0].operator_controlled);
  EXPECT_FALSE(robot.last.bodies[0].operator_controlled);
  EXPECT_GT((actuator.last.bodies[0].truth->position - Eigen::Vector3d(-1.5, 0, 1.2)).norm(), 0.1);
  EXPECT_EQ(actuator.last.bodies[0].input.size(), 0) << "no input is commanded";
  EXPECT_FALSE(robot.last.bodies[0].input.isZero());
  EXPECT_LT((actuator.last.bodies[0].truth->position - actuator.last.bodies[0].estimate.position).norm(),
            0.3);
  const std::string why = complaint(operator_controlled, {"operator.delay_s=0.5"});
  EXPECT_NE(why.find("belongs to `operator.holds = true`"), std::string::npos) << why;
}

/// A run without the identities of the points, and the score of its associations.
struct AssociatedRun {
  Ran ran;
  std::vector<SnapshotBody> states;
  std::int64_t right = 0, wrong = 0, missed = 0;
  int duplicate_landmarks = 0;
};

AssociatedRun run_associated(const LoadedScenario& loaded) {
  Assembly assembly = assemble(loaded);
  AssociationScore score(assembly.association_truth);
  AssociatedRun out;
  run_loop(assembly.parts, std::function<void(const Snapshot&)>([&](const Snapshot& s) {
             score.add(s);
             out.ran.last = s, ++out.ran.ticks;
             out.states.push_back(s.bodies.front());
           }),
           std::function<bool(const Tick&)>([](const Tick&) { return true; }));
  out.right = score.right(), out.wrong = score.wrong(), out.missed = score.missed();
  out.duplicate_landmarks = score.duplicate_landmarks();
  return out;
}

const std::vector<std::string> without_identity = {"association.method=nearest"};

/// The estimate is the same to the last bit, whatever ids the world gives its points. Without noise, which is drawn for one
/// point after the other in the order of the ids.
TEST(PointScenarioRun, AssociationDoesNotDependOnTheIdsOfThePoints) {
  const Scratch scratch;
  const std::string text =
      "[world]\ntype = \"points\"\n[sensor]\ntype = \"camera\"\n[run]\nduration_s = 4\n"
      "[vehicle]\nmodel = \"free-camera\"\n[camera]\nkd1_per_px2 = 9e-6\n[start]\n"
      "positions_m = [[-1.5, 0, 1]]\n[points]\nfile = \"points.csv\"\nknown = 3\n[plant]\n"
      "sigma_pixel_px = 0\n[controller]\nlaw = \"active\"\n[association]\n"
      "method = \"nearest\"\n";
  const auto run_with = [&](const std::vector<int>& ids) {
    RandomStream random(3, "points");
    std::string table = "id,x,y,z\n";
    for (const int id : ids)
      table +=
          fmt::format("{},{},{},{}\n", id, random.uniform(1, 4), random.uniform(-3, 3), random.uniform(0, 2));
    scratch.write("points.csv", table);
    return run_associated(load_scenario(scratch.write("s.toml", text).string(), {}));
  };
  const AssociatedRun a = run_with({0, 1, 2, 3, 4, 5, 6, 7, 8, 9}),
                      b = run_with({0, 1, 2, 70, 9, 33, 5, 12, 3, 4});
  ASSERT_GT(a.ran.last.landmarks.size(), 6u);
  ASSERT_EQ(a.ran.last.landmarks.size(), b.ran.last.landmarks.size());
  for (std::size_t i = 0; i < a.states.size(); ++i) {
    ASSERT_EQ(a.states[i].estimate.position, b.states[i].estimate.position) << i;
    ASSERT_EQ(a.states[i].covariance, b.states[i].covariance) << i;
  }
  for (std::size_t i = 0; i < a.ran.last.landmarks.size(); ++i)
    EXPECT_EQ(a.ran.last.landmarks[i].position, b.ran.last.landmarks[i].position);
  EXPECT_EQ(a.right, b.right);
  EXPECT_GT(a.right, 100);
}

/// On the plane the distances between points are large beside their uncertainty.
TEST(PointScenarioRun, NearestNeighborAssociatesCorrectlyOnThePlane) {
  const std::string two = "start.positions_m=[[-2, 0, 0], [2, -6, 0]]";
  for (const char* seed : {"run.seed=1", "run.seed=2", "run.seed=3"}) {
    const std::vector<std::string> sets = {without_identity[0], seed, two,
                                           "path.offsets_m=[[0, 0, 0], [4, -6, 0]]"};
    const AssociatedRun n = run_associated(load(drive, sets));
    EXPECT_GT(n.right, 500);
    EXPECT_LT(n.wrong, n.right / 100);
    EXPECT_LT(n.missed, n.right / 10);
    EXPECT_LE(n.duplicate_landmarks, 1);
    EXPECT_EQ(n.ran.last.status.state, TrackingState::tracking);
  }
}

/// Thesis Section 6.3.1 from near the nominal start: a point enters the map with sigma / depth of 0.3 at most.
TEST(PointScenarioRun, DepthLinesBecomePointsOfKnownDepth) {
  const std::vector<std::string> sets{"run.duration_s=12", "decision.gaze=constant-rate",
                                      "plant.sigma_start_position_m=0.02", "plant.sigma_start_height_m=0.02",
                                      "plant.sigma_start_heading_rad=0.02"};
  Assembly assembly = assemble(load_scenario("free-camera-as-printed", sets));
  std::map<std::int64_t, double> entered;  // largest sigma over distance
  std::size_t most_lines = 0;
  Snapshot last;
  run_loop(
      assembly.parts,
      [&](const Snapshot& s) {
        std::size_t lines = 0;
        for (const SnapshotMatch& match : s.matches) lines += match.ray;
        most_lines = std::max(most_lines, lines);
        for (const SnapshotLandmark& l : s.landmarks) {
          const double distance_m = (l.position - s.bodies[0].estimate.position).norm();
          const double sigma_m = std::sqrt(l.covariance.eigenvalues().real().maxCoeff());
          if (!l.anchor) entered.emplace(l.id, sigma_m / distance_m);
        }
        last = s;
      },
      [](const Tick&) { return true; });
  EXPECT_GT(most_lines, 2u);
  EXPECT_LE(most_lines, 12u) << "map.wanted_visible";
  EXPECT_GT(entered.size(), 10u);
  for (const auto& [id, ratio] : entered) EXPECT_LT(ratio, 0.4) << id;
  EXPECT_LT((last.bodies[0].truth->position - last.bodies[0].estimate.position).norm(), 0.3);
}

/// Mean NEES of the pose per degree of freedom.
double mean_nees(const std::vector<SnapshotBody>& states) {
  double sum = 0;
  int count = 0;
  for (const SnapshotBody& v : states)
    if (const auto nees = pose_nees(pose_error(*v.truth, v.estimate), v.covariance)) sum += *nees, ++count;
  return sum / count;
}

/// Section 6.3.1, from a start that is known to 0.6 m and 45 degrees.
TEST(PointScenarioRun, AFreeCameraAssociatesAsConsistentlyAsWithKnownIdentities) {
  const std::vector<std::string> seeds = {"run.seed=1", "run.seed=2", "run.seed=6"};
  std::int64_t right = 0, wrong = 0, missed = 0;
  int duplicate_landmarks = 0;
  double nearest = 0, identified_nees = 0;
  for (const std::string& seed : seeds) {
    const std::vector<std::string> sets = {seed, "run.duration_s=7"};
    const AssociatedRun n = run_associated(load_scenario(
        "free-camera", std::vector<std::string>{sets[0], sets[1], "association.method=nearest"}));
    right += n.right, wrong += n.wrong, missed += n.missed, duplicate_landmarks += n.duplicate_landmarks;
    nearest += mean_nees(n.states) / static_cast<double>(seeds.size());
    Assembly identified = assemble(
        load_scenario("free-camera", std::vector<std::string>{sets[0], sets[1], "association.method=known"}));
    EXPECT_EQ(identified.association_truth, nullptr);
    std::vector<SnapshotBody> states;
    run_loop(identified.parts, std::function<void(const Snapshot&)>([&](const Snapshot& s) {
               states.push_back(s.bodies.front());
             }),
             std::function<bool(const Tick&)>([](const Tick&) { return true; }));
    identified_nees += mean_nees(states) / static_cast<double>(seeds.size());
  }
  RecordProperty("right", std::to_string(right)), RecordProperty("wrong", std::to_string(wrong));
  RecordProperty("missed", std::to_string(missed)),
      RecordProperty("duplicate_landmarks", std::to_string(duplicate_landmarks));
  EXPECT_GT(right, 4000);
  EXPECT_LT(static_cast<double>(wrong), 0.02 * static_cast<double>(right));
  EXPECT_LT(static_cast<double>(missed), 0.02 * static_cast<double>(right));
  EXPECT_LE(duplicate_landmarks, 3);
  EXPECT_LT(nearest, 1.3 * identified_nees);
}

TEST(PointScenarioRun, ReadsPointsAndPathsFromTables) {
  const Scratch scratch;
  scratch.write("points.csv", "id,x,y\n7,3,1\n9,-2,4\n");
  scratch.write("path.csv", "t,x,y\n0,-2,0\n2,-1,0\n4,0,0.5\n");
  std::string text = drive.substr(0, drive.find("[points]"));
  text +=
      "[points]\nfile = \"points.csv\"\nknown = -1\n[controller]\n"
      "law = \"feedback-linearization\"\n[path]\ntype = \"file\"\nfile = \"path.csv\"\n";
  const Ran ran = run(load_scenario(scratch.write("s.toml", text).string(), {}));
  ASSERT_EQ(ran.last.matches.size(), 2u);
  EXPECT_EQ(ran.last.matches[0].id, 7);
  EXPECT_TRUE(ran.last.matches[0].anchor);
  EXPECT_LT((ran.last.bodies[0].truth->position.head<2>() - ran.last.bodies[0].reference->head<2>()).norm(),
            0.4);
  scratch.write("points.csv", "id,x,y\n7,3,1\n7,-2,4\n");
  try {
    run(load_scenario((scratch.folder() / "s.toml").string(), {}));
    FAIL() << "an id twice";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("points.csv:3: landmark 7 occurs twice"), std::string::npos)
        << error.what();
  }
}

TEST(PointScenarioRun, APlantMayDifferFromTheModelOfItsFilter) {
  const auto error_with = [&](const std::vector<std::string>& sets) {
    const Ran ran = run(load(drive, sets));
    return (ran.last.bodies[0].truth->position - ran.last.bodies[0].estimate.position).norm();
  };
  const std::vector<std::string> blind = {"points.count=0", "points.known=0", "plant.sigma_speed_m_s=0",
                                          "plant.sigma_turn_rate_rad_s=0"};
  std::vector<std::string> other = blind;
  other.push_back("plant.speed_ratio=1.2");
  EXPECT_LT(error_with(blind), 0.05);
  EXPECT_GT(error_with(other), 0.2);
}

TEST(PointScenarioRun, MeasurementsMayBeRarerThanTicks) {
  Assembly assembly = assemble(load(drive, {"sensor.ticks_per_measurement=5"}));
  int measured = 0, ticks = 0;
  run_loop(assembly.parts, std::function<void(const Snapshot&)>([&](const Snapshot& s) {
             measured += !s.matches.empty();
             ++ticks;
           }),
           std::function<bool(const Tick&)>([](const Tick&) { return true; }));
  EXPECT_EQ(ticks, 60);
  EXPECT_EQ(measured, 12);
}

}  // namespace
}  // namespace incognita
