// The robot's side of the loop (estimator, decision, controller) does not depend on the truth: from the
// observations and ticks of a run alone, without a world, it gives the same estimates and commands.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "incognita/app/loop/assembly.hpp"
#include "incognita/app/loop/loop.hpp"
#include "incognita/io/scenario/load_scenario.hpp"
#include "incognita/record/mcap/snapshot_message.hpp"

namespace incognita {
namespace {

// An observation has no member for true quantities: no state of the world, and none of an operator's motion.
template <class T>
constexpr bool has_truth = requires(T o) {
  o.felt;
}
|| requires(T o) { o.truth; }
|| requires(T o) { o.states; }
|| requires(T o) { o.camera; };
static_assert(!has_truth<Observation> && !has_truth<BodyObservation>);

struct Given {
  std::vector<Tick> ticks;
  std::vector<Observation> observations;
};

class RecordingClock final : public Clock {
 public:
  RecordingClock(std::unique_ptr<Clock> clock, Given& given) : clock_(std::move(clock)), given_(given) {}
  Tick next() override {
    const Tick tick = clock_->next();
    if (tick) given_.ticks.push_back(tick);
    return tick;
  }
  std::int64_t expected_frames() const override { return clock_->expected_frames(); }

 private:
  std::unique_ptr<Clock> clock_;
  Given& given_;
};

class RecordingSensor final : public Sensor {
 public:
  RecordingSensor(std::unique_ptr<Sensor> sensor, Given& given) : sensor_(std::move(sensor)), given_(given) {}
  Observation measure(const std::optional<Truth>& truth, const Tick& tick) override {
    given_.observations.push_back(sensor_->measure(truth, tick));
    return given_.observations.back();
  }

 private:
  std::unique_ptr<Sensor> sensor_;
  Given& given_;
};

class GivenClock final : public Clock {
 public:
  explicit GivenClock(const Given& given) : given_(given) {}
  Tick next() override { return next_ < given_.ticks.size() ? given_.ticks[next_++] : Tick{}; }
  std::int64_t expected_frames() const override { return 0; }

 private:
  const Given& given_;
  std::size_t next_ = 0;
};

class NoWorld final : public World {
 public:
  std::optional<Truth> move(const Command&, const Tick&) override { return std::nullopt; }
};

class GivenSensor final : public Sensor {
 public:
  explicit GivenSensor(const Given& given) : given_(given) {}
  Observation measure(const std::optional<Truth>&, const Tick&) override {
    return given_.observations.at(next_++);
  }

 private:
  const Given& given_;
  std::size_t next_ = 0;
};

std::string text_of(const Command& command) {
  std::string text;
  const auto add = [&](const auto& numbers) {
    for (Eigen::Index i = 0; i < numbers.size(); ++i) text += fmt::format(" {}", numbers[i]);
  };
  for (const BodyCommand& body : command.bodies) {
    text += body.operator_controlled ? " shown" : " commanded";
    add(body.input);
    if (!body.shown) continue;
    add(body.shown->segment.from), add(body.shown->segment.to);
    text += body.shown->is_new ? " new" : "";
  }
  return text;
}

/// Keeps what the controller commands.
class RecordingController final : public Controller {
 public:
  RecordingController(std::unique_ptr<Controller> controller, std::vector<std::string>& commands)
      : controller_(std::move(controller)), commands_(commands) {}
  Command act(const Estimate& estimate, const Goal& goal, const Observation& observation,
              const Tick& tick) override {
    const Command command = controller_->act(estimate, goal, observation, tick);
    commands_.push_back(text_of(command));
    return command;
  }

 private:
  std::unique_ptr<Controller> controller_;
  std::vector<std::string>& commands_;
};

/// The output of the robot's side at each tick, as text that distinguishes any two numbers.
std::vector<std::string> run(LoopParts& parts) {
  std::vector<std::string> made, commands;
  parts.controller = std::make_unique<RecordingController>(std::move(parts.controller), commands);
  run_loop(
      parts,
      [&](const Snapshot& s) {
        Snapshot known = s;
        for (SnapshotBody& body : known.bodies) body.truth.reset();
        made.push_back(snapshot_message(known, true) + commands.back());
      },
      [](const Tick&) { return true; });
  return made;
}

/// `assembled`: constructs the same parts again.
template <class Assembled>
void expect_same_without_a_world(const Assembled& assembled) {
  Given given;
  auto with = assembled();
  with.parts.clock = std::make_unique<RecordingClock>(std::move(with.parts.clock), given);
  with.parts.sensor = std::make_unique<RecordingSensor>(std::move(with.parts.sensor), given);
  const std::vector<std::string> in_the_world = run(with.parts);
  auto without = assembled();
  without.parts.clock = std::make_unique<GivenClock>(given);
  without.parts.world = std::make_unique<NoWorld>();
  without.parts.sensor = std::make_unique<GivenSensor>(given);
  const std::vector<std::string> alone = run(without.parts);
  ASSERT_GT(in_the_world.size(), 20u);
  ASSERT_EQ(alone.size(), in_the_world.size());
  for (std::size_t k = 0; k < alone.size(); ++k) ASSERT_EQ(alone[k], in_the_world[k]) << "tick " << k;
}

LoadedScenario loaded(const std::string& name, const std::vector<std::string>& sets) {
  return load_scenario(name, sets, {});
}

TEST(WithheldTruth, FreeCameraInTheRoom) {
  for (const char* name : {"room", "hand-held"})
    expect_same_without_a_world([&] { return assemble(loaded(name, {"run.duration_s=3"})); });
}

TEST(WithheldTruth, VehicleInTheRoom) {
  expect_same_without_a_world([] { return assemble(loaded("explore-terrain", {"run.duration_s=2"})); });
}

TEST(WithheldTruth, Team) {
  for (const char* name : {"two-robots", "terrain"})
    expect_same_without_a_world([&] { return assemble(loaded(name, {"run.duration_s=4"})); });
}

TEST(WithheldTruth, HandHeldCameras) {
  expect_same_without_a_world([] {
    return assemble(
        loaded("free-camera", {"run.duration_s=3", "operator.holds=true", "operator.delay_s=0.1"}));
  });
}

}  // namespace
}  // namespace incognita
