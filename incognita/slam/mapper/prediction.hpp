// Prediction of the bodies with their time-stamped inputs and position fixes.
#pragma once

#include "incognita/messages/observation.hpp"
#include "incognita/messages/tick.hpp"
#include "incognita/slam/mapper/estimate.hpp"
#include "incognita/slam/mapper/settings.hpp"

namespace incognita {

/// Predicts one body to the time of the tick: by its odometry readings, each held until the next; by the one input that
/// it measured since the last tick; or by `commanded`, if the body's model says so. Position fixes, if used, correct it
/// at their own times with odometry, else at the tick. Sets `estimate.last.refused` when a fix or a wheel
/// reading is rejected.
void predict_body(Estimate& estimate, std::size_t which, const SmallVector& commanded,
                  const BodyObservation& observed, const Tick& tick, const EstimatorSettings& settings);

/// A motion that the motion model of a free camera did not expect.
struct Jump {
  Eigen::Vector3d turn;               ///< rotation vector, rad in camera axes
  double sigma_m = 0, sigma_rad = 0;  ///< of position and rotation, per axis
};

/// Turns the prediction of a free camera over the last `dt` seconds by a jump, and adds the uncertainty to its pose and, over
/// `dt`, to its velocity and rate. The rate does not follow the turn: shaking hands turn back in the next frame, and a camera
/// that goes on turning has the uncertainty to do so.
void add_jump(Estimate& estimate, std::size_t which, const Jump& jump, double dt);

/// Corrects a free camera with a wheel reading of its carrier: speed (m/s) and turn rate (rad/s, positive to the
/// left), means over the tick.
UpdateReport update_with_wheel_odometry(AnyBelief& belief, BlockId camera, const WheelOdometry& odometry,
                                        const Eigen::Vector2d& wheels);

/// Re-expresses a vehicle-frame map in the current vehicle frame. No-op for a world-frame map.
void recenter_map(Estimate& estimate);

}  // namespace incognita
