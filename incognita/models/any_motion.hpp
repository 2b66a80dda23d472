// Motion models chosen by the scenario: one type for all of them, with sizes known at run time.
#pragma once

#include "incognita/math/chart.hpp"
#include "incognita/math/small_matrix.hpp"
#include "incognita/models/motion/rigid_pose.hpp"
#include "incognita/models/registry.hpp"

namespace incognita {

/// Static properties of the model.
const MotionTraits& traits_of(const AnyMotion& motion);

/// State size: chart_of(motion).ambient(). Error size: chart_of(motion).tangent().
const Chart& chart_of(const AnyMotion& motion);
int inputs_of(const AnyMotion& motion);

/// d(state)/dt for a constant input; integrated by the simulated plant.
SmallVector rate_of(const AnyMotion& motion, const SmallVector& state, const SmallVector& input);

struct AnyStep {
  SmallVector x;  ///< state after dt
  SmallMatrix F;  ///< d(error after) / d(error before)
  SmallMatrix G;  ///< d(error after) / d(input)
};
AnyStep step_of(const AnyMotion& motion, const SmallVector& state, const SmallVector& input, double dt);

/// Pose of the body in space; z = 0 for motions on a plane, y = z = 0 for motions on a line.
RigidPose pose_of(const AnyMotion& motion, const SmallVector& state);
/// d(pose error) / d(state error), 6 x errors.
SmallMatrix pose_jacobian(const AnyMotion& motion, const SmallVector& state);
/// Heading about the world's z axis, from +x, rad; 0 on a line.
double heading_by(const AnyMotion& motion, const SmallVector& state);
/// State at rest at a position (m, world) with a heading (rad).
SmallVector at_rest(const AnyMotion& motion, const Eigen::Vector3d& position, double heading_rad);

/// The state after a displacement (m, world) and a turn about the world's z axis (rad); velocities are kept. Coordinates
/// that the motion does not have are ignored.
SmallVector displaced(const AnyMotion& motion, SmallVector state, const Eigen::Vector3d& by_m,
                      double turn_rad);

/// A position with its Jacobian with respect to the error of the state it is computed from.
struct AnyPoint {
  SmallVector position;  ///< 1, 2 or 3 numbers, m
  SmallMatrix J;         ///< d(position) / d(error)
};
/// Vehicle position in the dimensions of its motion.
AnyPoint position_of(const AnyMotion& motion, const SmallVector& vehicle);
/// Vehicle position in `dimensions` coordinates: missing ones are 0, surplus ones dropped.
AnyPoint position_of(const AnyMotion& motion, const SmallVector& vehicle, int dimensions);

}  // namespace incognita
