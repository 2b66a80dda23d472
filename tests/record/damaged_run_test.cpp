// Replay of a run of the loop, whole and with its log cut anywhere.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "incognita/app/loop/assembly.hpp"
#include "incognita/messages/errors.hpp"
#include "incognita/record/mcap/snapshot_message.hpp"
#include "incognita/record/recorder.hpp"
#include "incognita/record/replay/recorded_run.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using testing::contents;
using testing::Scratch;

/// Snapshots as a page gets them.
std::vector<std::string> record(const std::string& scenario, const std::vector<std::string>& sets,
                                const fs::path& folder) {
  Assembly assembly = assemble(load_scenario(scenario, sets));
  Recorder recorder(folder, assembly.info);
  std::vector<std::string> published;
  run_loop(
      assembly.parts,
      [&](const Snapshot& snapshot) {
        recorder.publish(snapshot);
        published.push_back(snapshot_message(snapshot, true));
      },
      [](const Tick&) { return true; });
  recorder.finish(RunStatus::done, "");
  return published;
}

TEST(DamagedRun, WholeRunIsReadBack) {
  const Scratch scratch;
  const auto published = record(
      "explore-room", {"run.duration_s=3", "landmark_initialization.method=depth-line"}, scratch / "run");
  const RecordedRun run(scratch / "run");
  ASSERT_EQ(run.frames(), 45);
  ASSERT_EQ(published.size(), 45u);
  for (std::size_t k = 0; k < published.size(); ++k) {
    Json expected = Json::parse(published[k]),
         found = Json::parse(run.frame_json(static_cast<std::int64_t>(k)))["snapshot"];
    EXPECT_TRUE(found.contains("exploration"));
    EXPECT_EQ(found["landmarks"].empty(), k < 1 && expected["landmarks"].empty());
    for (const char* about_once_a_second : {"landmarks", "exploration"})
      expected.erase(about_once_a_second), found.erase(about_once_a_second);
    ASSERT_EQ(found, expected) << k;
    EXPECT_TRUE(run.image(static_cast<std::int64_t>(k)));
  }
  const Json info = Json::parse(run.info_json());
  EXPECT_EQ(info["scenario"], "explore-room");
  EXPECT_EQ(info["camera"]["width"], 320);
  const Json series = Json::parse(run.series_json());
  EXPECT_EQ(series["columns"]["matched"][44], Json::parse(published[44])["matched"]);
  int initialized = 0, decisions = 0;
  for (const Json& event : series["events"]) {
    initialized += event["kind"] == "initialized";
    decisions += event["kind"] == "decision";
  }
  EXPECT_GE(initialized, series["columns"]["landmarks"][44]);
  EXPECT_EQ(decisions, 3) << "one a second";
}

/// The number of frames of a run with this log; 0 if it is refused.
std::int64_t frames_of(const fs::path& log) {
  try {
    const RecordedRun run(log);
    const Json last = Json::parse(run.frame_json(run.frames() - 1));
    EXPECT_EQ(last["snapshot"]["frame"], run.frames() - 1);
    return run.frames();
  } catch (const InputError& error) {
    EXPECT_HAS(error.what(), log.string() + ": at byte ");
    return 0;
  }
}

TEST(DamagedRun, CutAnywhereItHasFewerFramesOrIsRefused) {
  const Scratch scratch;
  record("two-robots", {"run.duration_s=6"}, scratch / "run");
  const fs::path log = scratch / "run" / "run.mcap";
  ASSERT_EQ(frames_of(log), 60);
  std::int64_t frames = 60;
  std::set<std::int64_t> found;
  for (std::uintmax_t size = (fs::file_size(log) - 1) / 1000 * 1000; size > 0; size -= 1000) {
    fs::resize_file(log, size);
    const std::int64_t now = frames_of(log);
    ASSERT_LE(now, frames) << size;
    found.insert(frames = now);
  }
  EXPECT_EQ(found, (std::set<std::int64_t>{0, 20, 40, 60})) << "chunks of 2 s";
}

}  // namespace
}  // namespace incognita
