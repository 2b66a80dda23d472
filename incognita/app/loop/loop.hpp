// The loop: world, sensor, estimator, decision and controller, connected by messages.
#pragma once

#include <functional>
#include <memory>

#include "incognita/control/camera_controller.hpp"
#include "incognita/control/team_controller.hpp"
#include "incognita/control/vehicle_controller.hpp"
#include "incognita/decision/camera_decision.hpp"
#include "incognita/decision/team_decision.hpp"
#include "incognita/decision/vehicle_decision.hpp"
#include "incognita/record/snapshot/snapshot.hpp"
#include "incognita/slam/features/camera_estimator.hpp"
#include "incognita/slam/points/team_estimator.hpp"
#include "incognita/world/world.hpp"

namespace incognita {

template <class Estimator_, class Decision, class Controller>
struct BoxesOf {
  using Estimator = Estimator_;
  std::unique_ptr<Clock> clock;
  std::unique_ptr<World> world;
  std::unique_ptr<Sensor> sensor;
  Estimator estimator;
  Decision decision;
  Controller controller;
};
using Boxes = BoxesOf<CameraEstimator, CameraDecision, CameraController>;
/// One or more vehicles with point measurements, estimated in one belief.
using TeamBoxes = BoxesOf<TeamEstimator, TeamDecision, TeamController>;

/// A vehicle that carries the camera through the rendered room.
using VehicleBoxes = BoxesOf<CameraEstimator, VehicleDecision, VehicleController>;

/// Runs until the clock ends or `keep_going` returns false. Exceptions of the components and of `publish` are
/// passed on. `watch`, if given, receives the estimate after each update with the trace of the changes to its belief.
template <class SomeBoxes>
void run_loop(SomeBoxes& boxes, const std::function<void(const Snapshot&)>& publish,
              const std::function<bool(const Tick&)>& keep_going,
              const std::function<void(const typename SomeBoxes::Estimator::Estimate&)>& watch = {});

}  // namespace incognita
