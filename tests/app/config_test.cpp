// The command `incognita config`, called as the program does.
#include "incognita/app/commands/config.hpp"

#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <set>

#include "incognita/io/scenario/load_scenario.hpp"
#include "tests/app/captured.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

using testing::message_of;
using testing::pgm;
using testing::Scratch;

using Answer = testing::Captured;

Answer run(const std::vector<std::string>& words) {
  Answer answer = testing::captured(add_config, words);
  EXPECT_EQ(answer.code, 0);
  return answer;
}

TEST(Config, PrintsEverySetting) {
  const Answer answer = run({"config", "room", "--set", "run.seed=7"});
  for (const SettingInForce& setting : load_scenario("room").settings) {
    EXPECT_HAS(answer.out, setting.key);
    EXPECT_HAS(answer.out, setting.help);
  }
  EXPECT_EQ(answer.out.find("[points]"), std::string::npos) << "only what is chosen";
  EXPECT_HAS(answer.out, "from --set");
  EXPECT_HAS(answer.out, "from room.toml:");
  EXPECT_HAS(answer.err, "run.seed = 7 (--set) replaces 1 (room.toml:");
}

TEST(Config, AnswersInJson) {
  const Answer answer = run({"config", "davison", "--json", "--set", "run.seed=7"});
  const nlohmann::json document = nlohmann::json::parse(answer.out);
  EXPECT_EQ(document.at("scenario"), "davison");
  ASSERT_EQ(document.at("settings").size(), load_scenario("davison").settings.size());
  for (const nlohmann::json& setting : document.at("settings")) {
    if (setting.at("key") == "run.seed") {
      EXPECT_EQ(setting.at("value"), 7);
      EXPECT_EQ(setting.at("default"), 1);
      EXPECT_EQ(setting.at("source"), "--set");
    }
    if (setting.at("key") == "camera.kd1_per_px2") {
      EXPECT_EQ(setting.at("value"), 9e-6);
      EXPECT_EQ(setting.at("unit"), "1/px^2");
    }
  }
}

TEST(Config, ListsTheSettingsOfAllScenarios) {
  const nlohmann::json document = nlohmann::json::parse(run({"config", "--all", "--json"}).out);
  std::set<std::string> keys;
  for (const nlohmann::json& setting : document.at("settings")) {
    EXPECT_TRUE(keys.insert(setting.at("key")).second) << setting;
    if (setting.at("key") == "path.radius_m") {
      EXPECT_HAS(setting.at("with").get<std::string>(), "path.type = \"circle\"");
    }
  }
  for (const char* key :
       {"run.seed", "camera.k1", "path.points_m", "sensor.baseline_m", "vehicle.wheelbase_m",
        "estimator.sigma_slip_m_s", "landmark_initialization.particles"})
    EXPECT_TRUE(keys.contains(key)) << key;
  for (const nlohmann::json& renamed : document.at("renamed"))
    EXPECT_TRUE(keys.contains(renamed.at("after").get<std::string>())) << renamed;
  EXPECT_HAS(run({"config", "--all"}).out, "[landmark_initialization]");
}

TEST(Config, ChecksTargetAndImages) {
  const Scratch scratch;
  const std::string file =
      scratch
          .write("s.toml", "[world]\ntype = \"recording\"\n[recording]\nfolder = \"" +
                               scratch.folder().string() + "/frames\"\n\n[start]\nfrom = \"free\"\n")
          .string();
  scratch.write("frames/rgb.txt", "1 a.pgm\n2 b.pgm\n");
  scratch.write("frames/a.pgm", pgm(320, 240));
  EXPECT_HAS(message_of([&] { run({"config", file, "--check"}); }), "b.pgm: is listed but does not exist");
  scratch.write("frames/b.pgm", pgm(320, 240));
  const Answer answer = run({"config", file, "--check"});
  EXPECT_HAS(answer.out, "all 2 images exist, the first is 320x240");
  EXPECT_HAS(answer.out, "s: valid");
  EXPECT_HAS(message_of([&] {
               run({"config", file, "--check", "--set", "camera.width_px=400"});
             }),
             "expect 400x240");
  EXPECT_HAS(
      message_of([&] {
        run({"config", file, "--check", "--set", "start.from=target", "--set", "start.target=no.toml"});
      }),
      "--set: start.target = \"no.toml\": there is no such file");
  EXPECT_HAS(message_of([&] { run({"config", "nothing"}); }), "no such scenario");
}

std::string refusal(const std::string& scenario, const std::vector<std::string>& sets) {
  std::vector<std::string> words{"config", scenario, "--check"};
  for (const std::string& set : sets) words.insert(words.end(), {"--set", set});
  return message_of([&] { run(words); });
}

TEST(Config, NamesWhereASequenceOrAStateWasSet) {
  EXPECT_HAS(refusal("explore-room", {"decision.strategy=fixed-path", "decision.sequence=go_forward jump"}),
             "--set: decision.sequence: `jump` is none of the actions");
  EXPECT_HAS(refusal("free-camera", {"estimator.map_frame=vehicle"}), "--set: estimator.map_frame = ");
}

TEST(Config, ListsEachPlaceOfAFileOnce) {
  const std::string built_in = refusal("circle", {"points.file=no.csv"});
  EXPECT_HAS(built_in, "(looked for those built in, ");
  EXPECT_EQ(built_in.find("those built in"), built_in.rfind("those built in")) << built_in;
  EXPECT_HAS(refusal("circle", {"points.file=/nowhere/no.csv"}), "(looked for /nowhere/no.csv)");
}

/// Odometry and detections of one vehicle in the format `tables`, which `auto` detects.
TEST(Config, RefusesTheRobotsOfARecordingOfOneVehicle) {
  const Scratch scratch;
  scratch.write("tables/odometry.csv", "t_s,speed_m_s,turn_rate_rad_s\n0,1,0\n0.1,1,0\n0.2,1,0\n");
  scratch.write("tables/detections.csv", "t_s,range_m,bearing_rad,identity\n0.1,3,0,1\n0.2,3,0,1\n");
  const std::string file =
      scratch
          .write("s.toml",
                 "[world]\ntype = \"recording\"\n[sensor]\ntype = \"range-bearing\"\n[vehicle]\n"
                 "model = \"differential-drive\"\n[recording]\nfolder = \"" +
                     (scratch / "tables").string() + "\"\n")
          .string();
  EXPECT_HAS(run({"config", file, "--check"}).out, "s: valid");
  EXPECT_HAS(run({"config", file, "--check", "--set", "recording.robot=1"}).out, "s: valid");
  const std::string robot = refusal(file, {"recording.robot=3"});
  EXPECT_HAS(robot, "--set: recording.robot = 3: ");
  EXPECT_HAS(robot, "has the format `tables`, a recording of one vehicle");
  EXPECT_HAS(robot, "; remove recording.robot");
  const std::string team = refusal(file, {"recording.team=true"});
  EXPECT_HAS(team, "--set: recording.team = true: ");
  EXPECT_HAS(team, "has the format `tables`, a recording of one vehicle");
  EXPECT_HAS(team, "; take recording.team = false");
}

TEST(Config, ItsHelpHasAnExample) {
  CLI::App app;
  std::function<int()> job;
  const std::string help = add_config(app, job)->help();
  EXPECT_HAS(help, "Example: incognita config room");
  for (const char* option : {"--set", "--check", "--json", "SCENARIO"}) EXPECT_HAS(help, option);
}

}  // namespace
}  // namespace incognita
