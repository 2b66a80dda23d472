// Commands of viewers take effect between two ticks of the loop.
#include "incognita/app/view/live_control.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "incognita/messages/errors.hpp"

namespace incognita {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr milliseconds soon{20}, at_last{10000};

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

Tick tick(double t) { return {static_cast<std::int64_t>(t * 10), t, 0.1}; }

class LiveControls : public ::testing::Test {
 protected:
  ~LiveControls() override {
    interrupted_ = true;
    if (loop_.joinable()) loop_.join();
  }

  void begin_as_fast_as_possible() {
    control_.begin();
    control_.command(SetSpeed{0});
  }

  /// A loop that asks for tick after tick and counts them, until it is told to end.
  void start_loop() {
    loop_ = std::thread([this] {
      while (control_.wait_for(tick(0.1 * ticks_))) {
        ++ticks_;
        std::this_thread::sleep_for(milliseconds(1));
      }
      ended_ = true;
    });
  }

  template <class Condition>
  bool comes(Condition condition) {
    const auto start = Clock::now();
    while (!condition() && Clock::now() - start < at_last) std::this_thread::sleep_for(milliseconds(1));
    return condition();
  }

  std::atomic<bool> interrupted_{false}, ended_{false};
  std::atomic<int> ticks_{0};
  LiveControl control_{[this] { return interrupted_.load(); }};
  std::thread loop_;
};

TEST_F(LiveControls, TimeStopsInAPauseAndStepsAreSingleTicks) {
  begin_as_fast_as_possible();
  control_.command(PauseRun{});
  start_loop();
  std::this_thread::sleep_for(soon);
  EXPECT_EQ(ticks_, 0);
  control_.command(StepRun{});
  EXPECT_TRUE(comes([&] { return ticks_ == 1; }));
  control_.command(StepRun{});
  control_.command(StepRun{});
  EXPECT_TRUE(comes([&] { return ticks_ == 3; }));
  std::this_thread::sleep_for(soon);
  EXPECT_EQ(ticks_, 3);
  control_.command(ResumeRun{});
  EXPECT_TRUE(comes([&] { return ticks_ > 10; }));
}

TEST_F(LiveControls, AStepPausesARun) {
  LiveState state;
  control_.on_change = [&](const LiveState& changed) { state = changed; };
  begin_as_fast_as_possible();
  control_.command(StepRun{});
  EXPECT_TRUE(state.paused);
  EXPECT_TRUE(control_.wait_for(tick(0)));
}

TEST_F(LiveControls, SpeedIsRunTimePerWallTime) {
  control_.begin();
  control_.command(SetSpeed{2});
  const auto start = Clock::now();
  EXPECT_TRUE(control_.wait_for(tick(5)));  // the first tick is due at once, whatever its time
  EXPECT_LT(seconds_since(start), 5);
  EXPECT_TRUE(control_.wait_for(tick(5.2)));
  EXPECT_GE(seconds_since(start), 0.1);
}

TEST_F(LiveControls, ALateLoopDoesNotHurryToCatchUp) {
  control_.begin();
  ASSERT_TRUE(control_.wait_for(tick(0)));
  std::this_thread::sleep_for(milliseconds(600));
  ASSERT_TRUE(control_.wait_for(tick(0.1)));  // 0.5 s late
  const auto start = Clock::now();
  EXPECT_TRUE(control_.wait_for(tick(0.3)));
  EXPECT_GE(seconds_since(start), 0.15);
}

TEST_F(LiveControls, AnInterruptionEndsWaiting) {
  control_.begin();
  control_.command(PauseRun{});
  start_loop();
  interrupted_ = true;
  EXPECT_TRUE(comes([&] { return ended_.load(); }));
  EXPECT_FALSE(control_.wait_for_start());
}

TEST_F(LiveControls, StopEndsTheRunAndTheNextOneIsNotStopped) {
  begin_as_fast_as_possible();
  control_.command(StopRun{});
  EXPECT_FALSE(control_.wait_for(tick(0)));
  control_.begin();
  EXPECT_TRUE(control_.wait_for(tick(0)));
}

TEST_F(LiveControls, StartEndsTheRunAndIsGivenOnce) {
  begin_as_fast_as_possible();
  control_.command(StartRun{"room", {"run.seed=7"}});
  EXPECT_FALSE(control_.wait_for(tick(0)));
  control_.end("completed", "");
  const auto start = control_.wait_for_start();
  ASSERT_TRUE(start);
  EXPECT_EQ(start->scenario, "room");
  EXPECT_EQ(start->settings, std::vector<std::string>{"run.seed=7"});
  control_.begin();
  EXPECT_TRUE(control_.wait_for(tick(0)));
  interrupted_ = true;
  EXPECT_FALSE(control_.wait_for_start());
}

TEST_F(LiveControls, AStartThatComesBeforeTheRunBeginsEndsThatRun) {
  control_.command(StartRun{"room", {}});
  ASSERT_TRUE(control_.wait_for_start());
  control_.command(StartRun{"terrain", {}});  // while the room is loaded
  control_.begin();
  EXPECT_FALSE(control_.wait_for(tick(0)));
  EXPECT_EQ(control_.wait_for_start()->scenario, "terrain");
}

TEST_F(LiveControls, InterventionsAreGivenOnceInTheirOrder) {
  control_.begin();
  control_.command(Intervention{CoverLens{true}});
  control_.command(Intervention{GiveBackBody{1}});
  const auto taken = control_.take_interventions();
  ASSERT_EQ(taken.size(), 2u);
  EXPECT_TRUE(std::holds_alternative<CoverLens>(taken[0]));
  EXPECT_TRUE(std::holds_alternative<GiveBackBody>(taken[1]));
  EXPECT_TRUE(control_.take_interventions().empty());
}

TEST_F(LiveControls, InterventionsNeedARunThatGoesOn) {
  EXPECT_THROW(control_.command(Intervention{CoverLens{}}), InputError);
  control_.begin();
  control_.command(Intervention{CoverLens{}});
  control_.end("completed", "");
  EXPECT_THROW(control_.command(Intervention{CoverLens{}}), InputError);
  control_.begin();
  EXPECT_TRUE(control_.take_interventions().empty()) << "those of the run before";
}

TEST_F(LiveControls, InterventionsThatWaitAreBounded) {
  control_.begin();
  control_.command(PauseRun{});
  for (int i = 0; i < 1000; ++i) control_.command(Intervention{CoverLens{}});
  EXPECT_THROW(control_.command(Intervention{CoverLens{}}), InputError);
}

TEST_F(LiveControls, ChangesOfSettingsThatWaitAreFew) {
  control_.begin();
  for (int i = 0; i < 10; ++i) control_.command(Intervention{ChangeDecision{{"decision.strategy=random"}}});
  EXPECT_THROW(control_.command(Intervention{ChangeDecision{{"decision.strategy=random"}}}), InputError);
  EXPECT_EQ(control_.take_interventions().size(), 10u);
  control_.command(Intervention{ChangeDecision{{"decision.strategy=random"}}});
}

TEST(LiveRobot, ARobotIsStoppedAtOnceAndOnlyDuringItsRun) {
  LiveControl control([] { return false; });
  LiveState state;
  control.on_change = [&](const LiveState& changed) { state = changed; };
  control.begin();
  EXPECT_THROW(control.command(StopRobot{true}), InputError) << "this run has no robot";
  std::vector<bool> stops;
  control.set_robot([&](bool stopped) { stops.push_back(stopped); });
  EXPECT_EQ(state.robot_stopped, false);
  control.command(StopRobot{true});
  EXPECT_EQ(stops, std::vector{true});
  EXPECT_EQ(state.robot_stopped, true);
  control.command(StopRobot{false});
  EXPECT_EQ(state.robot_stopped, false);
  control.end("done", "");
  EXPECT_FALSE(state.robot_stopped);
  EXPECT_THROW(control.command(StopRobot{true}), InputError);
}

TEST_F(LiveControls, ASaveIsRequestedDuringARunOnly) {
  int requests = 0;
  EXPECT_THROW(control_.command(SaveRun{}), InputError);
  control_.begin();
  control_.set_saving([&] { ++requests; });
  control_.command(SaveRun{});
  EXPECT_EQ(requests, 1);
  control_.end("done", "");
  EXPECT_THROW(control_.command(SaveRun{}), InputError);
  control_.begin();
  EXPECT_THROW(control_.command(SaveRun{}), InputError) << "the run before is no longer saved";
  EXPECT_EQ(requests, 1);
}

/// A pause must not keep a run from being saved, and a save no command from being taken.
TEST_F(LiveControls, SomethingCanBeDoneInAPause) {
  control_.begin();
  control_.command(PauseRun{});
  std::atomic<int> calls = 0;
  loop_ = std::thread([&] {
    control_.wait_for(tick(0), [&] {
      if (++calls == 1) control_.command(SetSpeed{2});
    });
    ended_ = true;
  });
  EXPECT_TRUE(comes([&] { return calls > 2; }));
  EXPECT_FALSE(ended_);
  control_.command(ResumeRun{});
  EXPECT_TRUE(comes([&] { return ended_.load(); }));
}

TEST_F(LiveControls, TheStateSaysHowARunEnded) {
  LiveState state;
  control_.on_change = [&](const LiveState& changed) { state = changed; };
  control_.begin();
  control_.command(SetSpeed{3});
  control_.command(PauseRun{});
  EXPECT_TRUE(state.running && state.paused);
  control_.end("failed", "the disk is full");
  EXPECT_FALSE(state.running || state.paused);
  EXPECT_EQ(state.ended_status, "failed");
  EXPECT_EQ(state.ended_reason, "the disk is full");
  control_.begin();
  EXPECT_EQ(state, (LiveState{true, false, 3, "", ""})) << "the next run keeps the speed only";
}

}  // namespace
}  // namespace incognita
