// A run that is saved and resumed in mid-course gives the same bytes as one that is not: the rows of its tables, and its
// whole state at the end.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "incognita/app/loop/saved_run.hpp"
#include "incognita/app/loop/scenario_run.hpp"
#include "incognita/io/scenario/load_scenario.hpp"
#include "incognita/messages/errors.hpp"
#include "incognita/record/recorder.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

using testing::message_of;
using testing::Scratch;

/// The run directory alone, as a campaign keeps it.
struct FolderSink final : RunSink {
  FolderSink(const std::filesystem::path& folder, const RunInfo& info) : recorder(folder, info) {}
  void publish(const Snapshot& snapshot) override { recorder.publish(snapshot); }
  void note(const ObservabilityReport& report, const std::vector<std::string>&) override {
    recorder.note(report);
  }
  void note(const std::string& key, const SummaryValue& value) override { recorder.note(key, value); }
  RunOutcome finish(RunStatus status, const std::string& reason, const std::vector<std::string>&) override {
    return recorder.finish(status, reason);
  }
  Recorder recorder;
};

/// Interventions at given frames.
struct Planned final : InterventionSource {
  std::vector<Intervention> due(const Tick& tick) override {
    const auto found = plan.find(tick.frame);
    return found == plan.end() ? std::vector<Intervention>{} : found->second;
  }
  void refused(const Intervention&, const std::string& why) override { throw std::runtime_error(why); }
  LoadedScenario reloaded(const std::vector<std::string>& settings) override { return reload(settings); }
  std::map<std::int64_t, std::vector<Intervention>> plan;
  std::function<LoadedScenario(const std::vector<std::string>&)> reload;
};

struct Job {
  std::string scenario;
  std::vector<std::string> settings = {};
  std::map<std::int64_t, std::vector<Intervention>> interventions = {};
  bool needs_recording = false;  ///< which may not be here
};

struct Done {
  RunOutcome outcome;
  std::string state;  ///< as saved at the end
};

struct Part {
  std::int64_t frames = -1;  ///< it is interrupted after the frames before that one; negative: never
  const StateFile* resumed = nullptr;  ///< its start
};

Done run(const Job& job, const std::filesystem::path& folder, const Part& part = {}) {
  const auto load = [&](const std::vector<std::string>& further) {
    if (part.resumed) return scenario_of(*part.resumed, {}, {}, further);
    std::vector<std::string> all = job.settings;
    all.insert(all.end(), further.begin(), further.end());
    return load_scenario(job.scenario, all);
  };
  Planned planned;
  planned.plan = job.interventions;
  planned.reload = load;
  Done done;
  RunCallbacks callbacks;
  callbacks.report = [](const std::string&) {};
  callbacks.keep_going = [&](const Tick& tick) { return part.frames < 0 || tick.frame < part.frames; };
  if (!job.interventions.empty()) callbacks.interventions = &planned;
  callbacks.saving.write = [&](const std::string& bytes) { done.state = bytes; };
  callbacks.saving.resumed = part.resumed;
  callbacks.saving.reload = load;
  const auto open = [&](const RunInfo& info, std::int64_t) {
    return std::make_unique<FolderSink>(folder, info);
  };
  done.outcome = run_scenario(load({}), open, callbacks);
  return done;
}

/// The lines after the first, which is a header.
std::vector<std::string> rows(const std::filesystem::path& table) {
  std::vector<std::string> found = testing::lines(table);
  if (!found.empty()) found.erase(found.begin());
  return found;
}

bool has_rows_per_tick(const std::string& name) {
  if (name.starts_with("adjusted") || name == "timings.csv" || name == "map.csv" || name == "surveyed.csv")
    return false;
  return name.ends_with(".tum") || name.ends_with(".csv");
}

void expect_same_tables(const Scratch& scratch) {
  int tables = 0;
  for (const auto& entry : std::filesystem::directory_iterator(scratch / "whole")) {
    const std::string name = entry.path().filename().string();
    if (!has_rows_per_tick(name)) continue;
    std::vector<std::string> joined = rows(scratch / "first" / name);
    const std::vector<std::string> second = rows(scratch / "second" / name);
    joined.insert(joined.end(), second.begin(), second.end());
    EXPECT_TRUE(joined == rows(entry.path())) << name;
    ++tables;
  }
  EXPECT_GE(tables, 3);
  for (const char* name : {"map.csv", "map.ply", "effective.toml"})
    EXPECT_TRUE(testing::contents(scratch / "second" / name) == testing::contents(scratch / "whole" / name))
        << name;
}

/// Section by section, so that a difference says where it is.
void expect_same_state(const Scratch& scratch, const std::string& whole, const std::string& resumed) {
  const StateFile a = read_state_file(scratch.write("a.state", whole));
  const StateFile b = read_state_file(scratch.write("b.state", resumed));
  ASSERT_EQ(a.sections.size(), b.sections.size());
  for (const StateSection& section : a.sections)
    EXPECT_TRUE(section.bytes == b.section(section.name).bytes) << section.name;
  EXPECT_TRUE(whole == resumed);
}

void expect_resumes(const Job& job, std::int64_t frames) {
  const Scratch scratch;
  std::optional<Done> whole;
  try {
    whole = run(job, scratch / "whole");
  } catch (const InputError& error) {
    if (!job.needs_recording) throw;
    GTEST_SKIP() << error.what();
  }
  const Done first = run(job, scratch / "first", {frames, nullptr});
  EXPECT_EQ(first.outcome.status, RunStatus::interrupted);
  const StateFile saved = read_state_file(scratch.write("saved.state", first.state));
  const Done second = run(job, scratch / "second", {-1, &saved});
  EXPECT_EQ(second.outcome.status, whole->outcome.status);
  EXPECT_GT(rows(scratch / "second" / "series.csv").size(), 5u);
  expect_same_tables(scratch);
  expect_same_state(scratch, whole->state, second.state);
}

TEST(Resume, TheRenderedRoom) { expect_resumes({"room", {"run.duration_s=3"}}, 47); }

TEST(Resume, BeforeTheEstimateStarts) {
  expect_resumes({"room", {"run.duration_s=1"}, {{0, {CoverLens{true}}}, {15, {CoverLens{false}}}}}, 8);
}

TEST(Resume, AfterTheFirstFrame) { expect_resumes({"room", {"run.duration_s=0.5"}}, 1); }

TEST(Resume, ALostCamera) {
  expect_resumes({"room", {"run.duration_s=3"}, {{20, {CoverLens{true}}}, {50, {CoverLens{false}}}}}, 40);
}

TEST(Resume, RaysWithDepthHypotheses) {
  expect_resumes({"room",
                  {"run.duration_s=2", "landmark_initialization.method=depth-line",
                   "sensor.sigma_lasting_px=0", "sensor.sigma_pixel_px=0.4"}},
                 29);
}

TEST(Resume, ErrorsOfMatchesThatLast) {
  expect_resumes(
      {"room", {"run.duration_s=2", "sensor.sigma_lasting_px=0.3", "sensor.adapt_sigma_pixel=false"}}, 31);
}

TEST(Resume, WithoutATarget) { expect_resumes({"room", {"run.duration_s=2", "start.from=free"}}, 30); }

TEST(Resume, TheInformationForm) {
  expect_resumes({"two-robots", {"run.duration_s=10", "estimator.form=information"}}, 41);
}

TEST(Resume, AnExploredRoom) { expect_resumes({"explore-room", {"run.duration_s=3"}}, 25); }
TEST(Resume, AVehicleOnUnevenGround) { expect_resumes({"explore-terrain", {"run.duration_s=3"}}, 22); }
TEST(Resume, AnOperator) { expect_resumes({"hand-held", {"run.duration_s=4"}}, 30); }
TEST(Resume, ACarriedCamera) { expect_resumes({"rendered-terrain", {"run.duration_s=2"}}, 33); }

TEST(Resume, TwoRobots) { expect_resumes({"two-robots", {"run.duration_s=20"}}, 71); }
TEST(Resume, AnLqgRegulator) { expect_resumes({"lqg", {"run.duration_s=20"}}, 61); }
TEST(Resume, ACircle) { expect_resumes({"circle", {"run.duration_s=20"}}, 77); }
TEST(Resume, UnknownAssociation) {
  expect_resumes({"two-robots", {"run.duration_s=15", "association.method=nearest"}}, 51);
}
TEST(Resume, AMapInTheFrameOfTheVehicle) {
  expect_resumes({"circle", {"run.duration_s=20", "estimator.map_frame=vehicle"}}, 67);
}
TEST(Resume, AnActiveCameraAmongPoints) { expect_resumes({"free-camera", {"run.duration_s=4"}}, 43); }
TEST(Resume, DepthLinesOfPoints) { expect_resumes({"free-camera-as-printed", {"run.duration_s=4"}}, 13); }
TEST(Resume, AnActiveVehicle) { expect_resumes({"terrain", {"run.duration_s=6"}}, 37); }

TEST(Resume, WhatAPersonDid) {
  const Job job{"explore-room",
                {"run.duration_s=6"},
                {{10, {AddImageNoise{3}, ChangeLight{0.8}}},
                 {20, {ChangeDecision{{"decision.strategy=random"}}, PushBody{0, {0.1, 0.1, 0}, 1}}},
                 {60, {TakeOverBody{0}, DriveBody{0, {1, 0, 0}, 0.2}}},
                 {75, {GiveBackBody{0}}}}};
  expect_resumes(job, 40);
}

TEST(Resume, WhileAPersonDrives) {
  expect_resumes(
      {"explore-room", {"run.duration_s=4"}, {{20, {TakeOverBody{0}, DriveBody{0, {0, 1, 0}, 0}}}}}, 40);
}

TEST(Resume, DavisonsSequence) { expect_resumes({"davison", {"run.duration_s=5"}, {}, true}, 71); }
TEST(Resume, ACarAmongPosts) { expect_resumes({"car-park", {"run.duration_s=30"}, {}, true}, 60); }
TEST(Resume, FiveRecordedRobots) { expect_resumes({"mrclam", {"run.duration_s=30"}, {}, true}, 90); }

// ---- A map in another run

TEST(SavedMap, IsRecognizedInAnotherRun) {
  const Scratch scratch;
  const Done mapped = run({"room", {"run.duration_s=5"}}, scratch / "map");
  const StateFile map = read_state_file(scratch.write("map.state", mapped.state));
  const std::vector<std::string> elsewhere{"run.duration_s=2", "room.start_position_m=[1.2, 0.3, 1.25]"};
  std::vector<TrackingState> states;
  std::vector<double> errors_m;
  RunCallbacks callbacks;
  callbacks.report = [](const std::string&) {};
  callbacks.saving.map = &map;
  struct Watching final : RunSink {
    explicit Watching(std::function<void(const Snapshot&)> f) : see(std::move(f)) {}
    void publish(const Snapshot& snapshot) override { see(snapshot); }
    void note(const ObservabilityReport&, const std::vector<std::string>&) override {}
    void note(const std::string&, const SummaryValue&) override {}
    RunOutcome finish(RunStatus status, const std::string& reason, const std::vector<std::string>&) override {
      return {status, reason};
    }
    std::function<void(const Snapshot&)> see;
  };
  const auto see = [&](const Snapshot& s) {
    states.push_back(s.status.state);
    if (s.status.state == TrackingState::lost) return;
    errors_m.push_back((s.bodies[0].estimate.position - s.bodies[0].truth->position).norm());
  };
  const RunOutcome outcome = run_scenario(
      load_scenario("room", elsewhere),
      [&](const RunInfo&, std::int64_t) { return std::make_unique<Watching>(see); }, callbacks);
  EXPECT_EQ(outcome.status, RunStatus::done) << outcome.reason;
  ASSERT_FALSE(states.empty());
  EXPECT_EQ(states.front(), TrackingState::lost);
  EXPECT_EQ(std::ranges::count(states, TrackingState::starting), 0);
  ASSERT_GT(errors_m.size(), 30u);
  EXPECT_LT(*std::ranges::max_element(errors_m), 0.1);
}

TEST(SavedMap, OfAnotherCameraIsRefused) {
  const Scratch scratch;
  const Done mapped = run({"room", {"run.duration_s=0.5"}}, scratch / "map");
  const StateFile map = read_state_file(scratch.write("map.state", mapped.state));
  const auto refusal = [&](const std::string& scenario, const std::vector<std::string>& settings) {
    RunCallbacks callbacks;
    callbacks.report = [](const std::string&) {};
    callbacks.saving.map = &map;
    return message_of([&] {
      run_scenario(
          load_scenario(scenario, settings),
          [](const RunInfo&, std::int64_t) -> std::unique_ptr<RunSink> { return nullptr; }, callbacks);
    });
  };
  EXPECT_HAS(refusal("room", {"camera.fu_px=200"}), "camera.fu_px = 200.0: the map of ");
  EXPECT_HAS(refusal("circle", {}), "a saved map can be used with the same camera and filter only");
}

// ---- What cannot go on

TEST(Resume, SettingsThatCannotChangeAreNamed) {
  const Scratch scratch;
  const Done done = run({"circle", {"run.duration_s=1"}}, scratch / "run");
  const StateFile saved = read_state_file(scratch.write("saved.state", done.state));
  const std::vector<std::string> noise{"sensor.sigma_range_m=0.5"}, longer{"run.duration_s=2"};
  EXPECT_HAS(message_of([&] { scenario_of(saved, noise); }),
             "--set: `sensor.sigma_range_m` cannot change in the middle of a run; only run.duration_s and "
             "run.save_every_s can");
  const std::vector<Flag> seed{{"run.seed", "7", "--seed"}};
  EXPECT_HAS(message_of([&] { scenario_of(saved, {}, seed); }), "--seed: `run.seed` cannot change");
  EXPECT_EQ(scenario_of(saved, longer).scenario.run.duration_s, 2);
  EXPECT_HAS(message_of([&] {
               run({"circle"}, scratch / "again", {-1, &saved});
             }),
             "extend it with --duration");
  EXPECT_FALSE(std::filesystem::exists(scratch / "again"));
}

/// Checksums fit: what is damaged is refused all the same.
void expect_damage_refused(const Job& job, const std::vector<std::string>& sections) {
  const Scratch scratch;
  const Done done = run(job, scratch / "run", {20, nullptr});
  const StateFile saved = read_state_file(scratch.write("saved.state", done.state));
  for (const StateSection& section : saved.sections) {
    if (!sections.empty() && std::ranges::find(sections, section.name) == sections.end()) continue;
    StateFile other = saved;
    StateSection& damaged = *std::ranges::find(other.sections, section.name, &StateSection::name);
    const auto refusal = [&] { return message_of([&] { run(job, scratch / "again", {-1, &other}); }); };
    damaged.bytes += "1";
    EXPECT_HAS(refusal(), "section `" + section.name + "`, byte ");
    if (section.bytes.empty()) continue;
    damaged.bytes = section.bytes.substr(0, section.bytes.size() - 1);
    EXPECT_HAS(refusal(), "section `" + section.name + "`, byte ");
  }
  EXPECT_FALSE(std::filesystem::exists(scratch / "again"));
}

TEST(Resume, ADamagedSectionIsRefused) { expect_damage_refused({"two-robots", {"run.duration_s=5"}}, {}); }
TEST(Resume, ADamagedMapOfImagesIsRefused) {
  expect_damage_refused({"room", {"run.duration_s=1"}}, {"estimate", "estimator"});
}

/// The whole state, as often as the setting says.
TEST(Resume, SavesWhileItRuns) {
  for (const auto& [every_s, least, most] : {std::tuple{"0", 1, 1}, std::tuple{"0.2", 5, 6}}) {
    int saves = 0;
    RunCallbacks callbacks;
    callbacks.report = [](const std::string&) {};
    callbacks.saving.write = [&](const std::string&) { ++saves; };
    const Scratch scratch;
    const std::vector<std::string> settings{"run.duration_s=1", std::string("run.save_every_s=") + every_s};
    run_scenario(
        load_scenario("circle", settings),
        [&](const RunInfo& info, std::int64_t) {
          return std::make_unique<FolderSink>(scratch / "run", info);
        },
        callbacks);
    EXPECT_GE(saves, least);
    EXPECT_LE(saves, most);
  }
}

/// A disk that is full for some time costs saves, and not the run.
TEST(Resume, AFailedSaveDoesNotEndTheRun) {
  int saves = 0;
  std::vector<std::string> said;
  RunCallbacks callbacks;
  callbacks.report = [&](const std::string& line) { said.push_back(line); };
  callbacks.saving.write = [&](const std::string&) {
    if (++saves <= 2) throw RecordError("the disk is full");
  };
  const Scratch scratch;
  const std::vector<std::string> settings{"run.duration_s=1", "run.save_every_s=0.2"};
  const auto open = [&](const RunInfo& info, std::int64_t) {
    return std::make_unique<FolderSink>(scratch / "run", info);
  };
  EXPECT_EQ(run_scenario(load_scenario("circle", settings), open, callbacks).status, RunStatus::done);
  EXPECT_EQ(std::ranges::count(said, "the disk is full"), 2);
  callbacks.saving.write = [](const std::string&) { throw RecordError("the disk is full"); };
  const RunOutcome failed = run_scenario(load_scenario("circle", settings), open, callbacks);
  EXPECT_EQ(failed.status, RunStatus::failed);
  EXPECT_EQ(failed.reason, "the disk is full");
}

/// Saves a run twice: in its middle, after a frame or while the loop waits before the next, and at its end.
struct SavedOnRequest {
  std::string in_between, at_end;
  std::vector<SaveReport> reports;
};

SavedOnRequest save_on_request(const std::filesystem::path& folder, bool while_waiting) {
  constexpr std::int64_t frame = 10;
  bool requested = false;
  std::function<void()> save_if_requested;
  SavedOnRequest saved;
  RunCallbacks callbacks;
  callbacks.report = [](const std::string&) {};
  callbacks.keep_going = [&](const Tick& tick) {
    requested |= tick.frame == (while_waiting ? frame : frame - 1);
    if (while_waiting) save_if_requested();
    return true;
  };
  callbacks.saving.is_requested = [&] { return std::exchange(requested, false); };
  callbacks.saving.may_wait = [&](std::function<void()> save) { save_if_requested = std::move(save); };
  callbacks.saving.on_save = [&](const SaveReport& report) { saved.reports.push_back(report); };
  callbacks.saving.write = [&](const std::string& bytes) {
    (saved.in_between.empty() ? saved.in_between : saved.at_end) = bytes;
  };
  run_scenario(
      load_scenario("room", std::vector<std::string>{"run.duration_s=1"}),
      [&](const RunInfo& info, std::int64_t) { return std::make_unique<FolderSink>(folder, info); },
      callbacks);
  return saved;
}

/// A run that is paused is saved as it was after its last frame, and goes on unchanged.
TEST(Resume, ASaveWhileTheLoopWaitsIsTheSame) {
  const Scratch scratch;
  const SavedOnRequest after = save_on_request(scratch / "after", false);
  const SavedOnRequest waiting = save_on_request(scratch / "waiting", true);
  ASSERT_FALSE(after.in_between.empty());
  EXPECT_TRUE(waiting.in_between == after.in_between);
  EXPECT_TRUE(waiting.at_end == after.at_end);
  EXPECT_FALSE(waiting.at_end == waiting.in_between);
  ASSERT_EQ(waiting.reports.size(), 1u) << "the save at the end was not requested";
  EXPECT_EQ(waiting.reports[0].bytes, waiting.in_between.size());
  EXPECT_NEAR(waiting.reports[0].t, 9 / 30.0, 1e-9);
  EXPECT_EQ(waiting.reports[0].failure, "");
}

/// Who asks before the first frame, or in the last, is answered as well.
TEST(Resume, ARequestIsAlwaysAnswered) {
  bool requested = true;
  std::function<void()> save_if_requested;
  std::vector<SaveReport> reports;
  RunCallbacks callbacks;
  callbacks.report = [](const std::string&) {};
  callbacks.keep_going = [&](const Tick& tick) {
    save_if_requested();
    EXPECT_EQ(reports.size(), tick.frame > 0 ? 1u : 0u);
    requested |= tick.frame == 5;
    return tick.frame < 5;
  };
  callbacks.saving.is_requested = [&] { return std::exchange(requested, false); };
  callbacks.saving.may_wait = [&](std::function<void()> save) { save_if_requested = std::move(save); };
  callbacks.saving.on_save = [&](const SaveReport& report) { reports.push_back(report); };
  callbacks.saving.write = [&](const std::string&) {
    if (!reports.empty()) throw RecordError("the disk is full");
  };
  const Scratch scratch;
  run_scenario(
      load_scenario("circle", std::vector<std::string>{"run.duration_s=1"}),
      [&](const RunInfo& info, std::int64_t) { return std::make_unique<FolderSink>(scratch / "run", info); },
      callbacks);
  ASSERT_EQ(reports.size(), 2u);
  EXPECT_EQ(reports[0].failure, "");
  EXPECT_EQ(reports[1].failure, "the disk is full");
}

}  // namespace
}  // namespace incognita
