// The loop: five boxes, five messages, one door.
#pragma once

#include <functional>
#include <memory>

#include "incognita/control/camera_controller.hpp"
#include "incognita/decision/camera_decision.hpp"
#include "incognita/record/snapshot.hpp"
#include "incognita/slam/camera_estimator.hpp"
#include "incognita/world/world.hpp"

namespace incognita {

struct Boxes {
  std::unique_ptr<Clock> clock;
  std::unique_ptr<World> world;
  std::unique_ptr<Sensor> sensor;
  CameraEstimator estimator;
  CameraDecision decision;
  CameraController controller;
};

/// Runs until the clock ends or `keep_going` says no. Whatever the boxes and the record throw passes through;
/// what was published before stays published.
void run_loop(Boxes& boxes, const std::function<void(const Snapshot&)>& publish,
              const std::function<bool(const Tick&)>& keep_going);

}  // namespace incognita
