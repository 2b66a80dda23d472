// The command `incognita config`, called as the program does.
#include "incognita/app/commands/config.hpp"

#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "incognita/io/scenario/settings.hpp"
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
  Scenario scenario;
  for (const Setting& setting : settings_in_force(scenario)) EXPECT_HAS(answer.out, setting.key);
  EXPECT_HAS(answer.out, "from --set");
  EXPECT_HAS(answer.out, "from room.toml:");
  EXPECT_HAS(answer.err, "run.seed = 7 (--set) replaces 1 (room.toml:");
}

TEST(Config, AnswersInJson) {
  const Answer answer = run({"config", "davison", "--json", "--set", "run.seed=7"});
  const nlohmann::json document = nlohmann::json::parse(answer.out);
  EXPECT_EQ(document.at("scenario"), "davison");
  Scenario scenario;
  scenario.run.world = "recording";
  scenario.recording.format = "images";
  ASSERT_EQ(document.at("settings").size(), settings_in_force(scenario).size());
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

TEST(Config, ChecksTargetAndImages) {
  const Scratch scratch;
  const std::string file =
      scratch
          .write("s.toml", "[run]\nworld = \"recording\"\n[recording]\nfolder = \"" +
                               scratch.folder().string() + "/frames\"\n[start]\nfrom = \"free\"\n")
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

TEST(Config, ItsHelpHasAnExample) {
  CLI::App app;
  std::function<int()> job;
  const std::string help = add_config(app, job)->help();
  EXPECT_HAS(help, "Example: incognita config room");
  for (const char* option : {"--set", "--check", "--json", "SCENARIO"}) EXPECT_HAS(help, option);
}

}  // namespace
}  // namespace incognita
