// Motion models that a scenario chooses: one value for any of them, sizes known when the program runs.
#pragma once

#include <variant>

#include "incognita/math/chart.hpp"
#include "incognita/math/small_matrix.hpp"
#include "incognita/models/free_camera.hpp"
#include "incognita/models/monobot.hpp"
#include "incognita/models/planar_vehicle.hpp"
#include "incognita/models/rigid_pose.hpp"
#include "incognita/models/terrain_vehicle.hpp"

namespace incognita {

using AnyMotion =
    std::variant<MonobotMotion, DifferentialDrive, AckermannCar, TerrainVehicle, FreeCameraMotion>;

/// Numbers of the state: chart_of(motion).ambient(). Errors: chart_of(motion).tangent().
const Chart& chart_of(const AnyMotion& motion);
int inputs_of(const AnyMotion& motion);

/// d(state)/dt while the input is held: what a plant integrates.
SmallVector rate_of(const AnyMotion& motion, const SmallVector& state, const SmallVector& input);

struct AnyStep {
  SmallVector x;  ///< the state after dt
  SmallMatrix F;  ///< d(error after) / d(error before)
  SmallMatrix G;  ///< d(error after) / d(input)
};
AnyStep step_of(const AnyMotion& motion, const SmallVector& state, const SmallVector& input, double dt);

/// Where the vehicle's body is in space: on the floor z = 0 for one on a plane, along x for one on a line.
RigidPose pose_of(const AnyMotion& motion, const SmallVector& state);
/// d(pose error) / d(state error), 6 x errors.
SmallMatrix pose_jacobian(const AnyMotion& motion, const SmallVector& state);

}  // namespace incognita
