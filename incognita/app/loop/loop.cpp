#include "incognita/app/loop/loop.hpp"

#include "incognita/app/loop/snapshot_of.hpp"
#include "incognita/slam/mapper/stage_clock.hpp"

namespace incognita {
namespace {

/// Some decisions also use the observation, e.g. the wheel speeds.
template <class Decision, class Estimate>
Goal choose(Decision& decision, const Estimate& estimate, const Observation& observation, const Tick& tick) {
  if constexpr (requires { decision.choose(estimate, observation, tick); })
    return decision.choose(estimate, observation, tick);
  else
    return decision.choose(estimate, tick);
}

}  // namespace

template <class SomeBoxes>
void run_loop(SomeBoxes& boxes, const std::function<void(const Snapshot&)>& publish,
              const std::function<bool(const Tick&)>& keep_going,
              const std::function<void(const typename SomeBoxes::Estimator::Estimate&)>& watch) {
  auto& [clock, world, sensor, estimator, decision, controller] = boxes;
  typename SomeBoxes::Estimator::Estimate estimate;
  estimate.belief.keep_trace(watch != nullptr);
  Command command;
  std::vector<std::pair<const char*, double>> timing_ms;

  while (const Tick tick = clock->next()) {
    if (!keep_going(tick)) return;
    StageClock stage(timing_ms);
    const auto truth = world->move(command, tick);  // true motion (absent on a real robot)
    stage.mark("world");
    const Observation observation = sensor->measure(truth, tick);  // everything a robot can measure
    stage.mark("sensor");
    estimator.update(estimate, command, observation, tick);  // in place: belief, landmark catalog, status
    stage.mark("estimator");
    const Goal goal = choose(decision, estimate, observation, tick);  // action, reference, scores
    stage.mark("advice");
    command = controller.act(estimate, goal, observation, tick);
    stage.mark("control");
    if (watch) {
      watch(estimate);
      estimate.belief.clear_trace();
      stage.mark("watch");
    }
    publish(snapshot_of(tick, truth, observation, estimate, goal, decision.actions(), command, timing_ms));
  }
}

using Publish = std::function<void(const Snapshot&)>;
using KeepGoing = std::function<bool(const Tick&)>;
template void run_loop(Boxes&, const Publish&, const KeepGoing&, const std::function<void(const Estimate&)>&);
template void run_loop(VehicleBoxes&, const Publish&, const KeepGoing&,
                       const std::function<void(const Estimate&)>&);
template void run_loop(TeamBoxes&, const Publish&, const KeepGoing&,
                       const std::function<void(const TeamEstimate&)>&);

}  // namespace incognita
