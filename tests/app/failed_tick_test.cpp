// A tick that fails has no snapshot; what a person did at it is logged all the same, so that the log repeats the failure.
#include <gtest/gtest.h>

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "incognita/app/loop/scenario_run.hpp"
#include "incognita/io/scenario/load_scenario.hpp"

namespace incognita {
namespace {

struct Logged {
  std::vector<std::int64_t> published, failed;  ///< frames of interventions
};

struct Sink final : RunSink {
  explicit Sink(Logged& into) : logged(into) {}
  void publish(const Snapshot& snapshot) override {
    for (std::size_t i = 0; i < snapshot.interventions.size(); ++i)
      logged.published.push_back(snapshot.tick.frame);
  }
  void log(const Tick& tick, const std::vector<Intervention>& interventions) override {
    for (std::size_t i = 0; i < interventions.size(); ++i) logged.failed.push_back(tick.frame);
  }
  void note(const ObservabilityReport&, const std::vector<std::string>&) override {}
  void note(const std::string&, const SummaryValue&) override {}
  RunOutcome finish(RunStatus status, const std::string& reason, const std::vector<std::string>&) override {
    return {status, reason};
  }
  Logged& logged;
};

/// A disturbance at every tick.
struct Disturbing final : InterventionSource {
  std::vector<Intervention> due(const Tick&) override { return {DisplaceBody{0, {0.001, 0, 0}, 0}}; }
  void refused(const Intervention&, const std::string& why) override { throw std::runtime_error(why); }
  LoadedScenario reloaded(const std::vector<std::string>&) override {
    throw std::logic_error("not asked for");
  }
};

/// The run ends when that frame has been estimated.
RunOutcome run_until_failure(int frame, Logged& logged) {
  Disturbing disturbing;
  int updates = 0;
  RunCallbacks callbacks;
  callbacks.report = [](const std::string&) {};
  callbacks.interventions = &disturbing;
  callbacks.observe = [&](const ObservabilityWatch&) {
    if (updates++ == frame) throw std::runtime_error("it fails");
  };
  const std::vector<std::string> settings{"run.duration_s=5", "run.observability=true"};
  const LoadedScenario loaded = load_scenario("circle", settings);
  return run_scenario(
      loaded, [&](const RunInfo&, std::int64_t) { return std::make_unique<Sink>(logged); }, callbacks);
}

TEST(FailedTick, ItsInterventionsAreLogged) {
  Logged logged;
  const RunOutcome outcome = run_until_failure(3, logged);
  EXPECT_EQ(outcome.status, RunStatus::failed);
  EXPECT_EQ(outcome.reason, "at frame 3: it fails");
  EXPECT_EQ(logged.published, (std::vector<std::int64_t>{0, 1, 2}));
  EXPECT_EQ(logged.failed, (std::vector<std::int64_t>{3}));
}

TEST(FailedTick, TheFirstOneToo) {
  Logged logged;
  run_until_failure(0, logged);
  EXPECT_TRUE(logged.published.empty());
  EXPECT_EQ(logged.failed, (std::vector<std::int64_t>{0}));
}

}  // namespace
}  // namespace incognita
