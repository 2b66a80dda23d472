// The loop: world, sensor, estimator, strategy and controller, connected by messages.
#pragma once

#include <functional>
#include <memory>

#include "incognita/app/loop/map_truth.hpp"
#include "incognita/control/controller.hpp"
#include "incognita/decision/strategy.hpp"
#include "incognita/record/snapshot/snapshot.hpp"
#include "incognita/slam/mapper/estimator.hpp"
#include "incognita/world/world.hpp"

namespace incognita {

/// The parts of the loop; any of them may be a user's own.
struct LoopParts {
  std::unique_ptr<Clock> clock;
  std::unique_ptr<World> world;
  std::unique_ptr<Sensor> sensor;
  std::unique_ptr<Estimator> estimator;
  std::unique_ptr<Strategy> strategy;
  std::unique_ptr<Controller> controller;
  std::unique_ptr<MapTruth> map_truth = nullptr;  ///< evaluates the map; null where its truth is unknown
};

/// What the loop carries from one tick to the next, besides its parts.
struct LoopState {
  Estimate estimate;
  Command command;  ///< for the next tick
  Tick tick;        ///< the last one that was done
};

/// Runs until the clock ends or `keep_going` returns false. Exceptions of the parts and of `publish` are
/// passed on. `watch`, if given, receives the estimate after each update with the trace of the changes to its belief.
void run_loop(LoopParts& parts, const std::function<void(const Snapshot&)>& publish,
              const std::function<bool(const Tick&)>& keep_going,
              const std::function<void(const Estimate&)>& watch = {});

/// The same from a state on, which is that of the last tick then. `done`, if given, is called after each tick, when the state is
/// that of a run which ends there.
void run_loop(LoopParts& parts, LoopState& state, const std::function<void(const Snapshot&)>& publish,
              const std::function<bool(const Tick&)>& keep_going,
              const std::function<void(const Estimate&)>& watch, const std::function<void()>& done);

}  // namespace incognita
