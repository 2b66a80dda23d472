// Scenarios of point landmarks that are refused, with the key and the reason.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/app/point_scenario.hpp"

namespace incognita {
namespace {

using namespace testing;

TEST(PointScenario, RefusesAtStartWithTheReason) {
  const auto refused = [&](const std::vector<std::string>& sets, const char* key, const char* because) {
    const std::string why = complaint(drive, sets);
    EXPECT_NE(why.find(key), std::string::npos) << key << ": " << why;
    EXPECT_NE(why.find(because), std::string::npos) << key << ": " << why;
  };
  refused({"vehicle.sensor_forward_m=0"}, "vehicle.sensor_forward_m", "axle");
  refused({"vehicle.sensor_forward_m=1e-9"}, "vehicle.sensor_forward_m", "axle");
  refused({"points.known=41"}, "points.known", "points.count");
  refused({"start.positions_m=[[0, 0, 1]]"}, "start.positions_m", "z of 0");
  refused({"start.sigma_position_m=100", "health.max_sigma_position_m=10"}, "start.sigma_position_m", "lost");
  refused({"controller.gain_per_s=[1, 1, 1]"}, "controller.gain_per_s", "1 number or 2");
  refused({"path.rate_rad_s=0"}, "path.rate_rad_s", "must not be 0");
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

TEST(PointScenario, RefusesDepthLinesThatCannotBe) {
  const std::string camera = text_of({"free-camera", "wide-angle", "none"});
  const std::string line = "landmark_initialization.method=depth-line";
  EXPECT_EQ(complaint(camera, {line}), "");
  const std::string range = complaint(camera, {line, "landmark_initialization.max_depth_m=0.4"});
  EXPECT_NE(range.find("landmark_initialization.max_depth_m = 0.4: must be more than "
                       "landmark_initialization.min_depth_m, which is 0.5"),
            std::string::npos)
      << range;
  const std::string prior = complaint(camera, {line, "landmark_initialization.inverse_depth_per_m=0.3"});
  EXPECT_NE(prior.find("belongs to `landmark_initialization.method = \"inverse-depth\"`"), std::string::npos)
      << prior;
  const std::string stereo = complaint(text_of({"free-camera", "stereo", "none"}), {line});
  EXPECT_NE(stereo.find("`landmark_initialization.method` belongs to `sensor.type = \"camera\"`"),
            std::string::npos)
      << stereo;
}

TEST(PointScenario, RefusesVehiclesAtOnePositionThatMeasureEachOther) {
  const std::string why = complaint(drive, {"start.positions_m=[[0, 0, 0], [3, 0, 0]]"});
  EXPECT_NE(why.find("path.offsets_m"), std::string::npos) << why;
  EXPECT_NE(why.find("sensor.measures_vehicles"), std::string::npos) << why;
  const std::string one_place =
      complaint(drive, {"start.positions_m=[[0, 0, 0], [0, 0, 0]]", "path.offsets_m=[[0, 0, 0], [3, 0, 0]]"});
  EXPECT_NE(one_place.find("vehicles 1 and 2 start in one place"), std::string::npos) << one_place;
  load(drive, {"start.positions_m=[[0, 0, 0], [3, 0, 0]]", "sensor.measures_vehicles=false"});
  load(drive, {"start.positions_m=[[0, 0, 0], [3, 0, 0]]", "path.offsets_m=[[0, 0, 0], [3, 0, 0]]"});
}

/// A plant has the parameters of the model of the filter unless others are given.
TEST(PointScenario, PlantHasTheParametersOfTheModelWithinWiderLimits) {
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

TEST(PointScenario, NamesTheConstantInputThatExceedsALimit) {
  const std::string held = text_of({"differential-drive", "range-bearing", "none"});
  const std::string why = complaint(held, {"controller.input=[1, 1]", "controller.max_turn_rate_rad_s=0.5"});
  EXPECT_NE(why.find("--set: controller.input = [1.0, 1.0]: the constant input exceeds"), std::string::npos)
      << why;
  EXPECT_NE(why.find("; here controller.max_turn_rate_rad_s = 0.5 (--set)"), std::string::npos) << why;
}

/// The setting of the command line is named first: the others fitted each other without it.
TEST(PointScenario, NamesTheSettingsThatDoNotFitTheControlLaw) {
  const auto refused = [](const std::string& text, const std::vector<std::string>& sets, const char* first,
                          const char* other) {
    const std::string why = complaint(text, sets);
    EXPECT_TRUE(why.starts_with("--set: " + std::string(first) + " = ")) << why;
    EXPECT_NE(why.find(other + std::string(" = ")), std::string::npos) << why;
    EXPECT_NE(why.find("controller.law = "), std::string::npos) << why;
  };
  refused(drive, {"controller.gain_per_s=[40]"}, "controller.gain_per_s", "run.rate_hz");
  refused(drive, {"controller.gain_per_s=[-1]"}, "controller.gain_per_s", "controller.law");
  refused(drive, {"path.rate_rad_s=3"}, "path.rate_rad_s", "controller.max_speed_m_s");
  refused(drive, {"controller.max_speed_m_s=0.01"}, "controller.max_speed_m_s", "path.radius_m");
  refused(drive, {"controller.max_turn_rate_rad_s=0.01"}, "controller.max_turn_rate_rad_s",
          "path.rate_rad_s");
  refused(drive, {"run.rate_hz=0.2"}, "run.rate_hz", "controller.gain_per_s");
  refused(drive, {"controller.law=lqg"}, "controller.law", "path.type");
  const std::string tracks = text_of({"differential-drive", "range-bearing", "tracking"});
  refused(tracks, {"controller.gain_along_per_s=100"}, "controller.gain_along_per_s", "run.rate_hz");
  refused(tracks, {"controller.gain_across_per_m2=1e5"}, "controller.gain_across_per_m2",
          "controller.gain_heading_per_m");
  refused(tracks, {"controller.max_turn_rate_rad_s=50"}, "controller.max_turn_rate_rad_s", "run.rate_hz");
  const std::string lqg = text_of({"differential-drive", "range-bearing", "lqg"});
  refused(lqg, {"controller.weight_input=[-1]"}, "controller.weight_input", "controller.law");
  refused(lqg, {"controller.weight_state=[1e300]"}, "controller.weight_state", "controller.weight_input");
  const std::string flies = text_of({"free-camera", "wide-angle", "feedback-linearization"});
  refused(flies, {"controller.gain_position_per_s2=1e5"}, "controller.gain_position_per_s2",
          "controller.gain_velocity_per_s");
  refused(flies, {"controller.max_acceleration_m_s2=1e-4"}, "controller.max_acceleration_m_s2", "path.type");
  const std::string car = text_of({"ackermann", "range-bearing", "feedback-linearization"});
  refused(car, {"controller.max_speed_m_s=1000"}, "controller.max_speed_m_s", "controller.max_steering_rad");
}

TEST(PointScenario, RefusesTablesWithPositionsOffThePlane) {
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

TEST(PointScenario, RefusesGainsAndInputsOfTheWrongLength) {
  const std::string held = text_of({"differential-drive", "range-bearing", "none"}),
                    lqg = text_of({"differential-drive", "range-bearing", "lqg"});
  EXPECT_NE(complaint(held, {"controller.input=[1, 2, 3]"}).find("controller.input"), std::string::npos);
  EXPECT_NE(complaint(lqg, {"controller.weight_input=[1, 2, 3]"}).find("1 number or 2"), std::string::npos);
  EXPECT_NE(complaint(lqg, {"controller.weight_state=[]"}).find("controller.weight_state"),
            std::string::npos);
}

TEST(PointScenario, CountsOneInput) {
  const std::string line = text_of({"monobot", "range-bearing", "none"});
  const std::string why = complaint(line, {"controller.input=[1, 2]"});
  EXPECT_NE(why.find("must have 1 number, one for each input"), std::string::npos) << why;
}

TEST(PointScenario, RefusesKeysOfAnotherAlternative) {
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

TEST(PointScenario, ACarriedCameraRefusesSettingsThatItsCarrierLacks) {
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

TEST(PointScenario, RefusesItsSettingsInTheRenderedRoom) {
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

}  // namespace
}  // namespace incognita
