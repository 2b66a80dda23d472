// Scenarios of points: every motion with every sensor and every law, from the words of a scenario to a run,
// or refused with the reason.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>

#include "incognita/app/loop/assembly.hpp"
#include "incognita/app/loop/association_score.hpp"
#include "incognita/app/loop/loop.hpp"
#include "incognita/math/random.hpp"
#include "incognita/messages/errors.hpp"
#include "incognita/models/any_sensor.hpp"
#include "tests/merged_toml.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

using testing::Scratch;

struct Ran {
  int ticks = 0;
  Snapshot last;
};

Ran run(const LoadedScenario& loaded) {
  Assembly assembly = assemble(loaded);
  Ran ran;
  run_loop(
      assembly.parts, [&](const Snapshot& s) { ran.last = s, ++ran.ticks; },
      [](const Tick&) { return true; });
  return ran;
}

LoadedScenario load(const std::string& text, const std::vector<std::string>& sets = {}) {
  const Scratch scratch;
  return load_scenario(scratch.write("s.toml", testing::merged_toml(text)).string(), sets);
}

std::string complaint(const std::string& text, const std::vector<std::string>& sets = {}) {
  try {
    run(load(text, sets));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

struct Choice {
  std::string motion, sensor, law;
  const MotionTraits& traits() const { return motion_traits_of(motion); }
  bool line() const { return traits().on_line(); }
  bool plane() const { return traits().on_plane(); }
  bool body() const { return traits().in_space(); }
  /// A camera has one of two lenses.
  std::string sensor_word() const {
    return sensor == "wide-angle" || sensor == "pinhole" ? "camera" : sensor;
  }
  bool has_parameter(const std::string& key) const {
    for (const MotionEntry& entry : registered_motions())
      if (entry.traits.name == motion)
        for (const ParameterInfo& p : entry.parameters)
          if (p.quantity.key() == key) return true;
    return false;
  }

  bool sees() const {
    return incompatibility(make_motion(motion), make_sensor(sensor_word(), traits())).empty();
  }
  /// A car turns only while it moves, a regulator at rest knows no slopes.
  bool steers() const {
    const bool turns = plane() && traits().has_input("turn_rate");
    if (law == "tracking") return !traits().has_input("steering");
    if (law == "lqg") return line() || turns || body();
    return true;
  }
};

std::string steer_of(const Choice& c) {
  const std::string law = "[controller]\nlaw = \"" + c.law + "\"\n";
  if (c.law == "none")
    return law + (c.line()   ? "input = [0.1]\n"
                  : c.body() ? "input = [0.1, 0, 0, 0, 0.1, 0]\n"
                             : "input = [0.5, 0.1]\n");
  if (c.law == "active") return law;
  if (c.line() || c.law == "lqg")
    return law + "[path]\ntype = \"point\"\nposition_m = " +
           (c.line()   ? "[2, 0, 0]\n"
            : c.body() ? "[2, 0.5, 1]\n"
                       : "[2, 0.5, 0]\n");
  if (c.body()) return law + "[path]\ntype = \"back-and-forth\"\ncenter_m = [0, 0, 1]\nradius_m = 1.5\n";
  return law + "[path]\ntype = \"circle\"\nradius_m = 4\nrate_rad_s = 0.12\n";
}

std::string text_of(const Choice& c) {
  std::string text = "[run]\nrate_hz = 20\nduration_s = 3\n[world]\ntype = \"points\"\n[sensor]\ntype = \"" +
                     c.sensor_word() + "\"\n[vehicle]\nmodel = \"" + c.motion + "\"\n";
  for (const auto& [key, value] : {std::pair{"sensor_forward_m", "0.4"},
                                   {"sensor_left_m", "0"},
                                   {"wheelbase_m", "1"},
                                   {"wheel_left_m", "0.3"}})
    if (c.has_parameter(key)) text += std::string(key) + " = " + value + "\n";
  if (c.sensor == "wide-angle") text += "[camera]\nkd1_per_px2 = 9e-6\n";
  if (c.sensor == "pinhole") text += "[camera]\nmodel = \"pinhole\"\n";
  if (c.sensor != "wide-angle" && c.sensor != "pinhole" &&
      !measures_distance(make_sensor(c.sensor, c.traits())))
    text += "[landmark_initialization]\ninverse_depth_per_m = 0.15\nsigma_inverse_depth_per_m = 0.15\n";
  text += c.body() ? "[start]\npositions_m = [[-1.5, 0, 1]]\n" : "[start]\npositions_m = [[-2, 0, 0]]\n";
  return text + "[points]\ncount = 40\nsize_m = [12, 12, 2.5]\nknown = 8\n" + steer_of(c);
}

using Words = std::tuple<std::string, std::string, const char*>;

/// Of sensor.type, a camera with either lens.
std::vector<std::string> sensors_and_lenses() {
  std::vector<std::string> words{"wide-angle", "pinhole"};
  for (const std::string& word : sensor_words())
    if (word != "camera") words.push_back(word);
  return words;
}

class Blocks : public ::testing::TestWithParam<Words> {};

TEST_P(Blocks, RunOrAreRefusedWithTheReason) {
  const Choice c{std::get<0>(GetParam()), std::get<1>(GetParam()), std::get<2>(GetParam())};
  if (!c.sees() || !c.steers()) {
    const std::string why = complaint(text_of(c));
    EXPECT_NE(why.find(c.sees() ? "controller.law = " : "sensor.type = "), std::string::npos) << why;
    EXPECT_GT(why.size(), 60u) << why;
    return;
  }
  const Ran ran = run(load(text_of(c)));
  EXPECT_EQ(ran.ticks, 60);
  EXPECT_EQ(ran.last.status.state, TrackingState::tracking) << ran.last.status.reason;
  ASSERT_EQ(ran.last.bodies.size(), 1u);
  const SnapshotBody& v = ran.last.bodies.front();
  ASSERT_TRUE(v.truth.has_value());
  EXPECT_LT((v.truth->position - v.estimate.position).norm(), 0.5);
  EXPECT_EQ(v.reference.has_value(), c.law != "none");
  EXPECT_TRUE(std::isfinite(ran.last.entropy.total));
  EXPECT_EQ(ran.last.decision.actions.empty(), c.law != "active");
}

std::string name_of(const ::testing::TestParamInfo<Words>& info) {
  std::string name =
      std::string(std::get<0>(info.param)) + "_" + std::get<1>(info.param) + "_" + std::get<2>(info.param);
  for (char& c : name)
    if (c == '-') c = '_';
  return name;
}

INSTANTIATE_TEST_SUITE_P(
    All, Blocks,
    ::testing::Combine(::testing::ValuesIn(motion_names()), ::testing::ValuesIn(sensors_and_lenses()),
                       ::testing::Values("none", "tracking", "lqg", "feedback-linearization", "active")),
    name_of);

const std::string drive = text_of({"differential-drive", "range-bearing", "feedback-linearization"});

TEST(TeamScenario, RefusesAtStartWithTheReason) {
  const auto refused = [&](const std::vector<std::string>& sets, const char* key, const char* because) {
    const std::string why = complaint(drive, sets);
    EXPECT_NE(why.find(key), std::string::npos) << key << ": " << why;
    EXPECT_NE(why.find(because), std::string::npos) << key << ": " << why;
  };
  refused({"vehicle.sensor_forward_m=0"}, "vehicle.sensor_forward_m", "axle");
  refused({"vehicle.sensor_forward_m=1e-9"}, "vehicle.sensor_forward_m", "axle");
  refused({"points.known=41"}, "points.known", "points.count");
  refused({"start.positions_m=[[0, 0, 1]]"}, "start.positions_m", "z of 0");
  refused({"start.sigma_position_m=100"}, "start.sigma_position_m", "lost");
  refused({"controller.gain_per_s=[40]"}, "controller.law", "gain");
  refused({"controller.gain_per_s=[-1]"}, "controller.law", "gain");
  refused({"controller.gain_per_s=[1, 1, 1]"}, "controller.gain_per_s", "1 number or 2");
  refused({"path.rate_rad_s=0"}, "path.rate_rad_s", "must not be 0");
  refused({"path.rate_rad_s=3"}, "controller.law", "m/s");
  refused({"start.positions_m=[]"}, "start.positions_m", "one for each vehicle");
  refused({"start.headings_rad=[0, 1]"}, "start.headings_rad", "one for each vehicle");
  refused({"path.offsets_m=[[0, 0, 0], [1, 1, 0]]"}, "path.offsets_m", "one for each vehicle");
  refused({"estimator.linearization=linear"}, "estimator.linearization", "nearest");
  refused({"plant.motion=terrain"}, "`plant.motion` belongs to", "sensor.type");
  refused({"run.rate_hz=10000", "run.duration_s=1e7"}, "run.duration_s", "ticks");
  refused({"association.method=nearest", "association.initialization_probability=0.9"},
          "association.initialization_probability", "inside the gate of a landmark");
  refused({"points.file=nowhere.csv"}, "points.file = \"nowhere.csv\"", "there is no such file");
  refused({"points.file=nowhere.csv", "points.count=40"}, "`points.count` belongs to",
          "points.file = \"nowhere.csv\"");
}

TEST(TeamScenario, RefusesVehiclesThatSeeEachOtherInOnePlace) {
  const std::string why = complaint(drive, {"start.positions_m=[[0, 0, 0], [3, 0, 0]]"});
  EXPECT_NE(why.find("path.offsets_m"), std::string::npos) << why;
  EXPECT_NE(why.find("sensor.measures_vehicles"), std::string::npos) << why;
  const std::string one_place =
      complaint(drive, {"start.positions_m=[[0, 0, 0], [0, 0, 0]]", "path.offsets_m=[[0, 0, 0], [3, 0, 0]]"});
  EXPECT_NE(one_place.find("vehicles 1 and 2 start in one place"), std::string::npos) << one_place;
  load(drive, {"start.positions_m=[[0, 0, 0], [3, 0, 0]]", "sensor.measures_vehicles=false"});
  load(drive, {"start.positions_m=[[0, 0, 0], [3, 0, 0]]", "path.offsets_m=[[0, 0, 0], [3, 0, 0]]"});
}

/// What a filter may believe its vehicle may be, for it is that unless told otherwise.
TEST(TeamScenario, TruthsFollowBeliefsUpToTheirLimits) {
  int followers = 0;
  for (const char* vehicle : {"ackermann", "differential-drive", "free-camera"})
    for (const SettingInForce& setting :
         load(text_of({vehicle, std::string(vehicle) == "free-camera" ? "wide-angle" : "range-bearing",
                       "active"}))
             .settings) {
      if (!setting.source.starts_with("as ")) continue;
      ++followers;
      EXPECT_TRUE(setting.key.starts_with("plant.sigma_") || setting.key == "start.sigma_height_m")
          << setting.key;
      EXPECT_EQ(setting.value, setting.default_value) << setting.key;
    }
  EXPECT_GE(followers, 18);
  const std::string why = complaint(drive, {"vehicle.sigma_speed_m_s=0.3", "start.sigma_heading_rad=0.2"});
  EXPECT_EQ(why, "") << "the limits of the truth are those of the estimator or wider";
}

TEST(TeamScenario, RefusesTheInputThatIsHeldByItsOwnName) {
  const std::string held = text_of({"differential-drive", "range-bearing", "none"});
  const std::string why = complaint(held, {"controller.input=[1, 1]", "controller.max_turn_rate_rad_s=0.5"});
  EXPECT_NE(why.find("controller.input = [1, 1]"), std::string::npos) << why;
}

TEST(TeamScenario, RefusesTablesWithPlacesThatCanNotBe) {
  const Scratch scratch;
  scratch.write("path.csv", "t,x,y,z\n0,-2,0,0\n2,-1,0,1\n4,0,0.5,0\n");
  scratch.write("points.csv", "id,x,y,z\n7,3,1,2\n");
  const auto why = [&](const std::string& tail) {
    const std::string text = drive.substr(0, drive.find("[points]")) + tail;
    try {
      run(load_scenario(scratch.write("s.toml", text).string(), {}));
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const std::string off = why("[points]\nfile = \"points.csv\"\n[controller]\nlaw = \"none\"\n");
  EXPECT_NE(off.find("landmark 7 is off the plane"), std::string::npos) << off;
  const std::string up =
      why("[controller]\nlaw = \"feedback-linearization\"\n[path]\ntype = \"file\"\nfile = \"path.csv\"\n");
  EXPECT_NE(up.find("has z other than 0"), std::string::npos) << up;
}

TEST(TeamScenario, RefusesGainsAndInputsOfTheWrongLength) {
  const std::string held = text_of({"differential-drive", "range-bearing", "none"}),
                    lqg = text_of({"differential-drive", "range-bearing", "lqg"});
  EXPECT_NE(complaint(held, {"controller.input=[1, 2, 3]"}).find("controller.input"), std::string::npos);
  EXPECT_NE(complaint(lqg, {"controller.weight_input=[1, 2, 3]"}).find("1 number or 2"), std::string::npos);
  EXPECT_NE(complaint(lqg, {"controller.weight_state=[]"}).find("controller.weight_state"),
            std::string::npos);
  EXPECT_NE(complaint(lqg, {"controller.weight_input=[-1]"}).find("controller.law"), std::string::npos);
}

TEST(TeamScenario, RefusesWhatItWouldIgnore) {
  const auto ignored = [&](const std::string& set, const char* with) {
    const std::string why = complaint(drive, {set});
    EXPECT_NE(why.find(" belongs to "), std::string::npos) << set << ": " << why;
    EXPECT_NE(why.find(with), std::string::npos) << set << ": " << why;
  };
  ignored("vehicle.wheelbase_m=2", "vehicle.model");
  ignored("camera.fu_px=200", "sensor.type");
  ignored("room.boxes=3", "world.type");
  ignored("search.gate_sigmas=2", "world.type");
  ignored("controller.weight_state=[1]", "controller.law");
  ignored("controller.max_steering_rad=0.5", "vehicle.model");
  ignored("path.speed_m_s=1", "path.type");
  ignored("terrain.length_m=3", "vehicle.model");
  ignored("sensor.baseline_m=0.2", "sensor.type");
  ignored("decision.step_m=0.2", "controller.law");
  ignored("association.initialization_distance_m=2", "association.method");
  ignored("controller.gain_velocity_per_s=1", "vehicle.model");
  ignored("plant.sigma_pixel_px=1", "sensor.type");
}

/// A camera that a vehicle carries over uneven ground, thesis Section 6.4.
const std::string carried =
    "[world]\ntype = \"points\"\n[sensor]\ntype = \"camera\"\n[run]\nrate_hz = 15\n"
    "duration_s = 4\n[vehicle]\nmodel = \"free-camera\"\n[plant]\nmotion = \"terrain\"\n"
    "[terrain]\namplitude_m = 0.1\nlength_m = 3\n[camera]\nkd1_per_px2 = 9e-6\n[points]\n"
    "count = 31\nsize_m = [6, 6, 2.5]\nknown = 6\n";

TEST(TeamScenario, ACarriedCameraRefusesWhatItsCarrierCanNot) {
  const auto refused = [&](const std::string& law, const std::vector<std::string>& sets, const char* why) {
    const std::string said = complaint(carried + "[controller]\nlaw = \"" + law + "\"\n", sets);
    EXPECT_NE(said.find(why), std::string::npos) << why << ": " << said;
  };
  refused("tracking", {}, "must be `none` or `active`");
  refused("none", {"controller.input=[1, 0, 0, 0, 0, 0]"}, "must have 2 numbers");
  refused("active", {"decision.step_m=0.2"}, "here `plant.motion = \"terrain\"`");
  refused("active", {"decision.gaze=fisher"}, "here `plant.motion = \"terrain\"`");
  refused("active", {"controller.max_acceleration_m_s2=1"}, "here `plant.motion = \"terrain\"`");
  refused("active", {"operator.holds=true"}, "here `plant.motion = \"terrain\"`");
  refused("active", {"decision.accelerations=[[0.5, 0]]"}, "must have [0, 0]: to keep the speed");
  refused("active", {"decision.accelerations=[[0, 0]]", "decision.acceleration_m_s2=1"},
          "belongs to `decision.accelerations = []`");
  refused("active", {"start.positions_m=[[0, 0, 1]]"}, "is on the ground");
}

TEST(TeamScenario, ACarriedCameraDrivesAsItIsToldAndKnowsHowSureItIs) {
  const Ran held = run(load(carried + "[controller]\nlaw = \"none\"\ninput = [0.2, 0.1]\n"));
  const SnapshotBody& v = held.last.bodies.front();
  EXPECT_NEAR(v.truth->position.head<2>().norm(), 0.8, 0.25)
      << "4 s at 0.2 m/s, by a camera 0.6 m over ground that tilts it";
  EXPECT_LT((v.truth->position - v.estimate.position).norm(), 0.2);
  EXPECT_EQ(v.input.size(), 2);
  const Ran active = run(load(carried + "[controller]\nlaw = \"active\"\n"));
  EXPECT_EQ(active.last.decision.actions.size(), 7u);
  EXPECT_EQ(active.last.decision.actions[3], "slower");
  EXPECT_GE(active.last.decision.chosen, 0);
}

/// What a hand does nobody tells the filter, whose input stays 0; the hand moves it all the same.
TEST(TeamScenario, APersonMovesTheCamera) {
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

/// A run on points without names, and what of it was taken for what it is.
struct Nameless {
  Ran ran;
  std::vector<SnapshotBody> way;
  std::int64_t right = 0, wrong = 0, missed = 0;
  int duplicate_landmarks = 0;
};

Nameless run_nameless(const LoadedScenario& loaded) {
  Assembly assembly = assemble(loaded);
  AssociationScore score(assembly.association_truth);
  Nameless out;
  run_loop(assembly.parts, std::function<void(const Snapshot&)>([&](const Snapshot& s) {
             score.add(s);
             out.ran.last = s, ++out.ran.ticks;
             out.way.push_back(s.bodies.front());
           }),
           std::function<bool(const Tick&)>([](const Tick&) { return true; }));
  out.right = score.right(), out.wrong = score.wrong(), out.missed = score.missed();
  out.duplicate_landmarks = score.duplicate_landmarks();
  return out;
}

const std::vector<std::string> without_identity = {"association.method=nearest"};

/// Whatever the world calls its points: the estimate is the same, to the last bit. Without noise, which is
/// drawn for one point after the other, by their names.
TEST(TeamScenario, PointsWithoutNamesAreWhatTheyAreByTheirPlacesAlone) {
  const Scratch scratch;
  const std::string text =
      "[world]\ntype = \"points\"\n[sensor]\ntype = \"camera\"\n[run]\nduration_s = 4\n"
      "[vehicle]\nmodel = \"free-camera\"\n[camera]\nkd1_per_px2 = 9e-6\n[start]\n"
      "positions_m = [[-1.5, 0, 1]]\n[points]\nfile = \"points.csv\"\nknown = 3\n[plant]\n"
      "sigma_pixel_px = 0\n[controller]\nlaw = \"active\"\n[association]\n"
      "method = \"nearest\"\n";
  const auto run_with = [&](const std::vector<int>& ids) {
    RandomStream random(3, "places");
    std::string table = "id,x,y,z\n";
    for (const int id : ids)
      table +=
          fmt::format("{},{},{},{}\n", id, random.uniform(1, 4), random.uniform(-3, 3), random.uniform(0, 2));
    scratch.write("points.csv", table);
    return run_nameless(load_scenario(scratch.write("s.toml", text).string(), {}));
  };
  const Nameless a = run_with({0, 1, 2, 3, 4, 5, 6, 7, 8, 9}),
                 b = run_with({0, 1, 2, 70, 9, 33, 5, 12, 3, 4});
  ASSERT_GT(a.ran.last.landmarks.size(), 6u);
  ASSERT_EQ(a.ran.last.landmarks.size(), b.ran.last.landmarks.size());
  for (std::size_t i = 0; i < a.way.size(); ++i) {
    ASSERT_EQ(a.way[i].estimate.position, b.way[i].estimate.position) << i;
    ASSERT_EQ(a.way[i].covariance, b.way[i].covariance) << i;
  }
  for (std::size_t i = 0; i < a.ran.last.landmarks.size(); ++i)
    EXPECT_EQ(a.ran.last.landmarks[i].position, b.ran.last.landmarks[i].position);
  EXPECT_EQ(a.right, b.right);
  EXPECT_GT(a.right, 100);
}

/// On the plane points are far apart for how well they are seen.
TEST(TeamScenario, MatchesWhatItSeesOnThePlane) {
  const std::string two = "start.positions_m=[[-2, 0, 0], [2, -6, 0]]";
  for (const char* seed : {"run.seed=1", "run.seed=2", "run.seed=3"}) {
    const std::vector<std::string> sets = {without_identity[0], seed, two,
                                           "path.offsets_m=[[0, 0, 0], [4, -6, 0]]"};
    const Nameless n = run_nameless(load(drive, sets));
    EXPECT_GT(n.right, 500);
    EXPECT_LT(n.wrong, n.right / 100);
    EXPECT_LT(n.missed, n.right / 10);
    EXPECT_LE(n.duplicate_landmarks, 1);
    EXPECT_EQ(n.ran.last.status.state, TrackingState::tracking);
  }
}

/// Of the camera's pose, per degree of freedom, over a run.
double mean_nees(const std::vector<SnapshotBody>& way) {
  double sum = 0;
  int count = 0;
  for (const SnapshotBody& v : way)
    if (const auto nees = pose_nees(pose_error(*v.truth, v.estimate), v.covariance)) sum += *nees, ++count;
  return sum / count;
}

/// Section 6.3.1, from a start that is known to 0.6 m and 45 degrees.
TEST(TeamScenario, AFreeCameraFindsWhatItSeesAndIsAsSureOfItselfAsByNames) {
  const std::vector<std::string> seeds = {"run.seed=1", "run.seed=2", "run.seed=6"};
  std::int64_t right = 0, wrong = 0, missed = 0;
  int duplicate_landmarks = 0;
  double by_places = 0, by_names = 0;
  for (const std::string& seed : seeds) {
    const std::vector<std::string> sets = {seed, "run.duration_s=7"};
    const Nameless n = run_nameless(load_scenario(
        "free-camera", std::vector<std::string>{sets[0], sets[1], "association.method=nearest"}));
    right += n.right, wrong += n.wrong, missed += n.missed, duplicate_landmarks += n.duplicate_landmarks;
    by_places += mean_nees(n.way) / static_cast<double>(seeds.size());
    Assembly identified = assemble(
        load_scenario("free-camera", std::vector<std::string>{sets[0], sets[1], "association.method=known"}));
    EXPECT_EQ(identified.association_truth, nullptr);
    std::vector<SnapshotBody> way;
    run_loop(identified.parts, std::function<void(const Snapshot&)>([&](const Snapshot& s) {
               way.push_back(s.bodies.front());
             }),
             std::function<bool(const Tick&)>([](const Tick&) { return true; }));
    by_names += mean_nees(way) / static_cast<double>(seeds.size());
  }
  RecordProperty("right", std::to_string(right)), RecordProperty("wrong", std::to_string(wrong));
  RecordProperty("missed", std::to_string(missed)),
      RecordProperty("duplicate_landmarks", std::to_string(duplicate_landmarks));
  EXPECT_GT(right, 4000);
  EXPECT_LT(static_cast<double>(wrong), 0.02 * static_cast<double>(right));
  EXPECT_LT(static_cast<double>(missed), 0.02 * static_cast<double>(right));
  EXPECT_LE(duplicate_landmarks, 3);
  EXPECT_LT(by_places, 1.3 * by_names);
}

TEST(TeamScenario, SettingsOfTeamsMeanNothingToOthers) {
  const std::string why =
      complaint("[world]\ntype = \"room\"\n[start]\nfrom = \"free\"\n[controller]\nlaw = \"lqg\"\n");
  EXPECT_NE(why.find("`controller.law` belongs to "), std::string::npos) << why;
  const std::string sensor =
      complaint("[world]\ntype = \"room\"\n[sensor]\ntype = \"stereo\"\n[start]\nfrom = \"free\"\n");
  EXPECT_NE(
      sensor.find(
          "sensor.type = \"stereo\": must be `camera`; \"stereo\" belongs to `world.type = \"points\"`"),
      std::string::npos)
      << sensor;
}

TEST(TeamScenario, ReadsPlacesAndPathsFromTables) {
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

TEST(TeamScenario, APlantMayBeOtherThanItsFilterBelieves) {
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

TEST(TeamScenario, LooksMayBeRarerThanTicks) {
  Assembly assembly = assemble(load(drive, {"sensor.ticks_per_measurement=5"}));
  int looked = 0, ticks = 0;
  run_loop(assembly.parts, std::function<void(const Snapshot&)>([&](const Snapshot& s) {
             looked += !s.matches.empty();
             ++ticks;
           }),
           std::function<bool(const Tick&)>([](const Tick&) { return true; }));
  EXPECT_EQ(ticks, 60);
  EXPECT_EQ(looked, 12);
}

}  // namespace
}  // namespace incognita
