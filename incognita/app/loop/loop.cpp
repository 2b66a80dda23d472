#include "incognita/app/loop/loop.hpp"

#include "incognita/app/loop/snapshot_of.hpp"
#include "incognita/slam/mapper/stage_clock.hpp"

namespace incognita {

void run_loop(LoopParts& parts, const std::function<void(const Snapshot&)>& publish,
              const std::function<bool(const Tick&)>& keep_going,
              const std::function<void(const Estimate&)>& watch) {
  LoopState state;
  run_loop(parts, state, publish, keep_going, watch, {});
}

void run_loop(LoopParts& parts, LoopState& state, const std::function<void(const Snapshot&)>& publish,
              const std::function<bool(const Tick&)>& keep_going,
              const std::function<void(const Estimate&)>& watch, const std::function<void()>& done) {
  const auto& [clock, world, sensor, estimator, strategy, controller, map_truth] = parts;
  auto& [estimate, command, last] = state;
  estimate.belief.keep_trace(watch != nullptr);
  std::vector<std::pair<const char*, double>> timing_ms;

  while (const Tick tick = clock->next()) {
    if (!keep_going(tick)) return;
    StageClock stage(timing_ms);
    const auto truth = world->move(command, tick);  // true motion (absent on a real robot)
    stage.mark("world");
    const Observation observation = sensor->measure(truth, tick);  // everything a robot can measure
    stage.mark("sensor");
    estimator->update(estimate, command, observation, tick);  // in place: belief, landmarks, status
    stage.mark("estimator");
    const Goal goal = strategy->choose(estimate, observation, tick);  // action, reference, scores
    stage.mark("decision");
    command = controller->act(estimate, goal, observation, tick);
    stage.mark("control");
    if (watch) {
      watch(estimate);
      estimate.belief.clear_trace();
      stage.mark("watch");
    }
    last = tick;
    Snapshot snapshot = snapshot_of(tick, truth, observation, estimate, goal, *strategy, command, timing_ms);
    if (map_truth) map_truth->put(truth, *estimator, snapshot);
    publish(snapshot);
    if (done) done();
  }
}

}  // namespace incognita
