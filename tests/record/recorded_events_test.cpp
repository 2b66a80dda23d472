// Replay of logs that are written message by message: events, earlier versions, damaged messages.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "incognita/messages/errors.hpp"
#include "incognita/record/mcap/mcap_file.hpp"
#include "incognita/record/replay/recorded_run.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using testing::message_of;
using testing::Scratch;

/// Frame k with these landmarks, one tenth of a second after the last.
Json snapshot(int k, const std::vector<int>& landmark_ids = {}) {
  return {{"frame", k},
          {"t", 0.1 * k},
          {"dt", 0.1},
          {"state", "tracking"},
          {"reason", ""},
          {"bodies", Json::array({Json::object()})},
          {"matches", Json::array()},
          {"landmark_ids", landmark_ids}};
}

fs::path written(const fs::path& folder, const std::vector<std::string>& snapshots) {
  fs::create_directories(folder);
  McapFile file(folder / "run.mcap", "test");
  const std::uint16_t channel = file.add_channel("/snapshot", "incognita.Snapshot", "{}");
  for (std::size_t i = 0; i < snapshots.size(); ++i) file.write(channel, i * 100'000'000, snapshots[i]);
  file.close();
  return folder;
}

fs::path written(const fs::path& folder, const std::vector<Json>& snapshots) {
  std::vector<std::string> texts;
  for (const Json& one : snapshots) texts.push_back(one.dump());
  return written(folder, texts);
}

/// "3 lost why", one per event
std::vector<std::string> events(const RecordedRun& run) {
  std::vector<std::string> found;
  const Json series = Json::parse(run.series_json());
  for (const Json& event : series.at("events")) {
    const auto frame = event.at("frame").get<int>();
    EXPECT_NEAR(event.at("t").get<double>(), 0.1 * frame, 1e-12);
    found.push_back(std::to_string(frame) + " " + event.at("kind").get<std::string>() + " " +
                    event.at("text").get<std::string>());
  }
  return found;
}

using Lines = std::vector<std::string>;

TEST(RecordedEvents, LandmarksAreInitializedAndRemovedOnce) {
  const Scratch scratch;
  // 0 is an anchor; 7 is at infinity in frame 2
  std::vector<Json> frames{snapshot(0), snapshot(1, {0, 7, 8}), snapshot(2, {0, 8}), snapshot(3, {0, 7}),
                           snapshot(4, {0, 7, 9})};
  frames[3]["landmarks"] = Json::parse(R"([{"id":0,"kind":"anchor"},{"id":7,"kind":"landmark"}])");
  EXPECT_EQ(events(RecordedRun(written(scratch / "run", frames))),
            (Lines{"1 initialized landmark 7", "1 initialized landmark 8", "3 removed landmark 8",
                   "4 initialized landmark 9"}));
}

TEST(RecordedEvents, StatesDecisionsAndDisturbances) {
  const Scratch scratch;
  std::vector<Json> frames;
  for (int k = 0; k < 6; ++k) frames.push_back(snapshot(k));
  frames[1]["state"] = frames[2]["state"] = "lost";
  frames[1]["reason"] = frames[2]["reason"] = "2 of 12 features matched";
  frames[3]["state"] = "relocated";
  const Json decision = Json::parse(
      R"({"decided":true,"chosen":1,"candidates":[{"action":"stay"},{"action":"left","score":2}]})");
  frames[4]["bodies"] = Json::array({Json{{"decision", decision}}});
  frames[5]["interventions"] = Json::parse(R"([{"type":"push","body":1},{"type":"light","factor":0.5}])");
  const RecordedRun run(written(scratch / "run", frames));
  EXPECT_EQ(events(run), (Lines{"1 lost 2 of 12 features matched", "3 relocated ", "4 decision left",
                                "5 disturbance push", "5 disturbance light"}));
  EXPECT_EQ(Json::parse(run.info_json()).at("interventions"), frames[5]["interventions"]);
}

TEST(RecordedEvents, DecisionsOfATeamNameTheBody) {
  const Scratch scratch;
  Json one = snapshot(0), taken = one;
  const Json none = Json::parse(R"({"decided":true,"chosen":-1,"candidates":[{"action":"stay"}]})");
  const Json stay = Json::parse(R"({"decided":true,"chosen":0,"candidates":[{"action":"stay"}]})");
  one["bodies"] = Json::array({Json{{"decision", none}}, Json{{"decision", stay}}});
  EXPECT_EQ(events(RecordedRun(written(scratch / "run", std::vector{one}))),
            Lines{"0 decision body 2: stay"});
}

TEST(RecordedRun, OfAnEarlierVersionHasWhatIsKnown) {
  const Scratch scratch;
  written(scratch / "run", std::vector{snapshot(0), snapshot(1), snapshot(2)});
  scratch.write("run/summary.json", R"({"version":"0.0.9","seed":3,"ate_alignment":"sim3","status":"done"})");
  const Json json = Json::parse(RecordedRun(scratch / "run").info_json());
  EXPECT_EQ(json["name"], "run");
  EXPECT_EQ(json["version"], "0.0.9");
  EXPECT_EQ(json["seed"], 3);
  EXPECT_EQ(json["scale_known"], false);
  EXPECT_EQ(json["same_frame_as_truth"], false);
  EXPECT_EQ(json["bodies"], 1);
  EXPECT_NEAR(json["rate_hz"].get<double>(), 10, 1e-9);
  EXPECT_FALSE(json.contains("camera"));
  EXPECT_FALSE(json.contains("effective_toml"));
}

TEST(RecordedRun, FramesEndAtTheFirstDamagedSnapshot) {
  const Scratch scratch;
  const std::string first = snapshot(0, {4}).dump(), second = snapshot(1, {4}).dump();
  const std::string long_text(5000, 'x');
  for (const std::string& damaged :
       {std::string("{\"t\":"), std::string("[1,2]"), std::string("{}"),
        std::string("{\"t\":\"" + long_text + "\"}"),
        "{\"a\":" + std::string(100000, '[') + std::string(100000, ']') + "," + second.substr(1),
        snapshot(2, {4}).dump().replace(first.find("tracking"), 8, "trac\xffing")}) {
    const RecordedRun run(written(scratch / "run", std::vector{first, second, damaged, second}));
    EXPECT_EQ(run.frames(), 2) << damaged.substr(0, 100);
    EXPECT_HAS(run.damage(), "not a snapshot of this program");
    EXPECT_LT(run.damage().size(), 500u);
    EXPECT_EQ(events(run), Lines{"0 initialized landmark 4"}) << damaged.substr(0, 100);
    EXPECT_HAS(message_of([&] { RecordedRun none(written(scratch / "none", std::vector{damaged})); }),
               "the run can not be replayed");
  }
}

TEST(RecordedRun, RefusesALogWithoutSnapshots) {
  const Scratch scratch;
  {
    McapFile file(scratch / "run.mcap", "test");
    file.write(file.add_channel("/imu", "sensor_msgs/Imu", "{}"), 0, "{}");
    file.close();
  }
  EXPECT_HAS(message_of([&] { RecordedRun run(scratch.folder()); }), "run.mcap: no frame is complete");
}

}  // namespace
}  // namespace incognita
