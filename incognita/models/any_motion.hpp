// Motion models that a scenario chooses: one value for any of them, sizes known when the program runs.
#pragma once

#include "incognita/math/chart.hpp"
#include "incognita/math/small_matrix.hpp"
#include "incognita/models/registry.hpp"
#include "incognita/models/rigid_pose.hpp"

namespace incognita {

/// What the model states about itself.
const MotionTraits& traits_of(const AnyMotion& motion);

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
/// About the world's z axis, from +x, rad; 0 on a line.
double heading_by(const AnyMotion& motion, const SmallVector& state);
/// The state at rest at a place (m, world) with a heading (rad).
SmallVector at_rest(const AnyMotion& motion, const Eigen::Vector3d& position, double heading_rad);

/// A place with how it depends on what tells it.
struct AnyPoint {
  SmallVector position;  ///< 1, 2 or 3, m
  SmallMatrix J;         ///< d(position) / d(error)
};
/// Where a vehicle is, in the dimensions of its own motion.
AnyPoint position_of(const AnyMotion& motion, const SmallVector& vehicle);
/// In those of a place: what is on a plane or a line is at 0 in the others.
AnyPoint position_of(const AnyMotion& motion, const SmallVector& vehicle, int dimensions);

}  // namespace incognita
