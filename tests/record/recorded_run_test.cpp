// Replay of run directories that were recorded from synthetic snapshots.
#include "incognita/record/replay/recorded_run.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "incognita/messages/errors.hpp"
#include "incognita/record/files/image_text.hpp"
#include "incognita/record/mcap/snapshot_message.hpp"
#include "incognita/record/recorder.hpp"
#include "incognita/record/snapshot/series.hpp"
#include "synthetic_run.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using testing::contents;
using testing::message_of;
using testing::Scratch;
using testing::SyntheticRun;

RunInfo info() {
  RunInfo info;
  info.name = "synthetic";
  info.effective_toml = "[run]\nseed = 5\n";
  info.seed = 5;
  info.version = "0.1.0";
  info.rate_hz = 30;
  info.room = {{{-3, -3, 0}, {3, 3, 2.5}}, {}};
  return info;
}

std::shared_ptr<const Image> image_of(int frame) {
  return std::make_shared<Image>(24, 16, static_cast<std::uint8_t>(2 * frame));
}

/// Images from frame 5 on.
Snapshot snapshot_at(const SyntheticRun& run, int frame) {
  Snapshot snapshot = testing::synthetic_snapshot(run, frame);
  if (frame >= 5) snapshot.image = image_of(frame);
  return snapshot;
}

fs::path recorded(const fs::path& folder, const SyntheticRun& run = {}) {
  Recorder recorder(folder, info());
  for (int i = 0; i < run.frames; ++i) recorder.publish(snapshot_at(run, i));
  recorder.finish(RunStatus::done, "");
  return folder;
}

Json frame(const RecordedRun& run, int k) { return Json::parse(run.frame_json(k)).at("snapshot"); }
Json series(const RecordedRun& run) { return Json::parse(run.series_json()); }

TEST(RecordedRun, FramesAreTheSnapshotsWithTheirMostRecentMap) {
  const Scratch scratch;
  const RecordedRun run(recorded(scratch / "first"));
  EXPECT_EQ(run.name(), "first");
  EXPECT_EQ(run.damage(), "");
  ASSERT_EQ(run.frames(), 120);
  for (const int k : {0, 17, 50, 59, 60, 118}) {
    Json expected = Json::parse(snapshot_message(snapshot_at({}, k), false));
    const Json with_map = Json::parse(snapshot_message(snapshot_at({}, k / 30 * 30), true));
    expected["landmarks"] = with_map["landmarks"];
    expected["exploration"] = with_map["exploration"];
    EXPECT_EQ(frame(run, k), expected) << k;
  }
}

/// map.csv has the upper triangles of the covariances.
Json symmetric(Json landmarks) {
  for (Json& landmark : landmarks)
    for (const auto& [lower, upper] : {std::pair{3, 1}, {6, 2}, {7, 5}})
      landmark["covariance"][static_cast<std::size_t>(lower)] =
          landmark["covariance"][static_cast<std::size_t>(upper)];
  return landmarks;
}

TEST(RecordedRun, LastFrameHasTheFinalMap) {
  const Scratch scratch;
  recorded(scratch / "run");
  EXPECT_EQ(frame(RecordedRun(scratch / "run"), 119).at("landmarks"),
            symmetric(Json::parse(snapshot_message(snapshot_at({}, 119), true)).at("landmarks")));
  // Not that of another run
  fs::copy_file(scratch / "run" / "map.csv", scratch / "map.csv");
  const Json older = Json::parse(snapshot_message(snapshot_at({}, 90), true)).at("landmarks");
  for (const std::string& map :
       {std::string("id,kind\n1,anchor\n"), std::string("id,kind,x,y,z\nseven,a,1,2,3\n"),
        contents(scratch / "map.csv").substr(0, 600), std::string()}) {
    scratch.write("run/map.csv", map);
    EXPECT_EQ(frame(RecordedRun(scratch / "run"), 119).at("landmarks"), older) << map;
  }
}

TEST(RecordedRun, ImagesAreTheMostRecentOnes) {
  const Scratch scratch;
  const RecordedRun run(recorded(scratch / "run"));
  EXPECT_FALSE(run.image(4));
  EXPECT_EQ(run.image(5), jpeg(*image_of(5)));
  EXPECT_EQ(run.image(6), jpeg(*image_of(5))) << "every other one is recorded";
  EXPECT_EQ(run.image(7), jpeg(*image_of(7)));
  EXPECT_EQ(run.image(119), jpeg(*image_of(119)));
}

TEST(RecordedRun, RefusesFramesThatItDoesNotHave) {
  const Scratch scratch;
  const RecordedRun run(recorded(scratch / "run"));
  for (const int k : {-1, 120}) {
    EXPECT_HAS(message_of([&] { run.frame_json(k); }), "there is no frame " + std::to_string(k));
    EXPECT_HAS(message_of([&] { run.image(k); }), "the frames are 0 to 119");
  }
}

TEST(RecordedRun, SeriesHasTheColumnsOfTheTables) {
  const Scratch scratch;
  const RecordedRun run(recorded(scratch / "run"));
  const Json json = series(run);
  EXPECT_EQ(json["frames"], 120);
  EXPECT_EQ(json["first_frame"], 0);
  ASSERT_EQ(json["t"].size(), 120u);
  EXPECT_EQ(json["t"][50], 50 / 30.0);
  EXPECT_EQ(json["state"][2], "starting");
  EXPECT_EQ(json["state"][3], "tracking");
  const auto names = series_columns(true);
  ASSERT_EQ(json["columns"].size(), names.size());
  const auto row = series_row(snapshot_at({}, 50), true);
  for (std::size_t i = 0; i < names.size(); ++i) {
    ASSERT_EQ(json["columns"][names[i]].size(), 120u) << names[i];
    const Json& value = json["columns"][names[i]][50];
    if (std::isfinite(row[i]))
      EXPECT_EQ(value, row[i]) << names[i];
    else
      EXPECT_TRUE(value.is_null()) << names[i];
  }
  EXPECT_TRUE(json["columns"]["sigma_position_m"][0].is_null()) << "no pose yet";
  EXPECT_EQ(json["timing_ms"]["frame"][7], 5);
  EXPECT_EQ(json["timing_ms"]["birth"][20], 1);
  EXPECT_TRUE(json["timing_ms"]["birth"][21].is_null());
}

TEST(RecordedRun, SeriesWithoutTablesHasTimesAndStates) {
  const Scratch scratch;
  recorded(scratch / "run");
  fs::remove(scratch / "run" / "series.csv");
  fs::remove(scratch / "run" / "timings.csv");
  const Json json = series(RecordedRun(scratch / "run" / "run.mcap"));
  EXPECT_EQ(json["t"].size(), 120u);
  EXPECT_TRUE(json["columns"].empty());
  EXPECT_TRUE(json["timing_ms"].empty());
}

TEST(RecordedRun, SeriesThatEndsEarlyIsUnknownFromThere) {
  const Scratch scratch;
  recorded(scratch / "run");
  std::string text;
  for (const std::string& line : testing::lines(scratch / "run" / "series.csv")) {
    text += line + "\n";
    if (line.starts_with("1,")) break;
  }
  scratch.write("run/series.csv", text);
  const Json column = series(RecordedRun(scratch / "run"))["columns"]["predicted"];
  ASSERT_EQ(column.size(), 120u);
  EXPECT_EQ(column[30], 7);
  EXPECT_TRUE(column[31].is_null());
}

TEST(RecordedRun, RefusesTablesOfAnotherRun) {
  const Scratch scratch;
  recorded(scratch / "run");
  const RecordedRun run(scratch / "run");
  scratch.write("run/series.csv", "t,state,matched\n0,starting,1\n0.5,starting,1\n");
  EXPECT_HAS(message_of([&] { run.series_json(); }),
             "series.csv:3: t = 0.5, but frame 1 of run.mcap is at t = 0.0333");
  scratch.write("run/series.csv", "t,state,matched\n0,starting\n");
  EXPECT_HAS(message_of([&] { run.series_json(); }), "series.csv:2: 2 columns, the header has 3");
  scratch.write("run/series.csv", "matched\n1\n");
  EXPECT_HAS(message_of([&] { run.series_json(); }), "series.csv:1: no column `t`");
}

TEST(RecordedRun, InfoIsThatOfTheRunAndItsSettings) {
  const Scratch scratch;
  const RecordedRun run(recorded(scratch / "first"));
  const Json json = Json::parse(run.info_json());
  EXPECT_EQ(json["name"], "first");
  EXPECT_EQ(json["scenario"], "synthetic");
  EXPECT_EQ(json["seed"], 5);
  EXPECT_EQ(json["rate_hz"], 30);
  EXPECT_EQ(json["room"]["max"], Json::parse("[3,3,2.5]"));
  EXPECT_EQ(json["expected_frames"], 120);
  EXPECT_EQ(json["effective_toml"], "[run]\nseed = 5\n");
  EXPECT_EQ(json["interventions"], Json::array());
  EXPECT_EQ(json["manual"], false);
  EXPECT_FALSE(json.contains("damage"));
}

TEST(RecordedRun, SummaryIsThatOfTheRun) {
  const Scratch scratch;
  const RecordedRun run(recorded(scratch / "run"));
  EXPECT_EQ(Json::parse(run.summary_json()), Json::parse(contents(scratch / "run" / "summary.json")));
  scratch.write("run/summary.json", "{\"status\": ");
  EXPECT_HAS(message_of([&] { run.summary_json(); }), "summary.json: damaged");
  fs::remove(scratch / "run" / "summary.json");
  EXPECT_HAS(message_of([&] { run.summary_json(); }), "summary.json: no such file");
}

TEST(RecordedRun, CutRunsHaveFewerFrames) {
  const Scratch scratch;
  const fs::path log = recorded(scratch / "run") / "run.mcap";
  const std::string bytes = contents(log);
  fs::resize_file(log, bytes.size() * 3 / 4);
  const RecordedRun run(scratch / "run");
  EXPECT_EQ(run.frames(), 60) << "chunks of 2 s";
  EXPECT_HAS(run.damage(), "run.mcap: at byte ");
  EXPECT_EQ(Json::parse(run.info_json())["damage"], run.damage());
  EXPECT_EQ(frame(run, 59).at("landmarks"),
            Json::parse(snapshot_message(snapshot_at({}, 30), true)).at("landmarks"))
      << "map.csv is later";
  const Json json = series(run);
  EXPECT_EQ(json["columns"]["matched"].size(), 60u);
  EXPECT_FALSE(json["events"].empty());
  for (const Json& event : json["events"]) EXPECT_LT(event["frame"], 60);
}

TEST(RecordedRun, RefusesFoldersThatAreNoRuns) {
  const Scratch scratch;
  EXPECT_HAS(message_of([&] { RecordedRun run(scratch / "none"); }), "none: no such folder; name the folder");
  EXPECT_HAS(message_of([&] { RecordedRun run(scratch.folder()); }),
             ": no run.mcap is in it; name the folder");
  {
    Recorder nothing(scratch / "empty", info());
    nothing.finish(RunStatus::failed, "");
  }
  EXPECT_HAS(message_of([&] { RecordedRun run(scratch / "empty"); }), "run.mcap: at byte ");
}

TEST(RecordedRun, NamesTheFolderHoweverItIsGiven) {
  const Scratch scratch;
  recorded(scratch / "first");
  for (const std::string path : {"first", "first/", "first/.", "first/run.mcap"})
    EXPECT_EQ(RecordedRun(scratch / path).name(), "first") << path;
}

}  // namespace
}  // namespace incognita
