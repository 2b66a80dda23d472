// A motion of a system: where it starts, what inputs it holds in each segment, and what that makes of its
// states.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "incognita/analysis/systems/system_instance.hpp"
#include "incognita/math/random.hpp"

namespace incognita {

struct MotionSegment {
  SystemPoint start;
  double duration_s = 0;
};

struct SystemMotion {
  std::vector<MotionSegment> segments;
  /// What else the kind of motion would have let the inputs be at the start: one more set for each number
  /// that it draws, and for each input that enters nonlinearly.
  std::vector<Eigen::VectorXd> other_inputs;
};

/// Draws a start and inputs from the system's regions, as its kind of motion wants them, and follows its
/// equations from segment to segment. Throws SystemError where they leave where the expressions are defined.
SystemMotion draw_motion(const SystemInstance& instance, int segments, RandomStream& random);

/// A moment of a motion, with the transition from its start, exact derivatives:
/// dx(t) = Phi dx(0) + Jumps d, d what disturbed its states by at the starts of the later segments.
struct MotionSample {
  double t = 0;  ///< s
  SystemPoint point;
  Eigen::MatrixXd Phi;    ///< n x n
  Eigen::MatrixXd jumps;  ///< n x (disturbed states times later segments); 0 for segments to come
};

/// `per_segment` moments in each segment, its start the first of them, and the end of the last segment.
/// Integrated adaptively (Dormand-Prince, Odeint) to 1e-12, in the units of the states.
std::vector<MotionSample> follow(const SystemInstance& instance, const SystemMotion& motion, int per_segment);

}  // namespace incognita
