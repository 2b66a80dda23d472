// A motion of a system: its start, the held inputs of each segment, and the resulting states.
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
  /// Alternative inputs at the start that the kind of motion permits: one more set for each number that it
  /// draws, and for each input that enters nonlinearly.
  std::vector<Eigen::VectorXd> other_inputs;
};

/// Draws a start and inputs from the system's regions according to its kind of motion, and integrates the
/// equations from segment to segment. Throws SystemError if the states leave the domain of the expressions.
SystemMotion draw_motion(const SystemInstance& instance, int segments, RandomStream& random);

/// A moment of a motion, with the exact transition from its start: dx(t) = Phi dx(0) + jumps d, where d are
/// the disturbances of the states at the starts of the later segments.
struct MotionSample {
  double t = 0;  ///< s
  SystemPoint point;
  Eigen::MatrixXd Phi;    ///< n x n
  Eigen::MatrixXd jumps;  ///< n x (disturbed states times later segments); 0 for segments to come
};

/// `per_segment` samples in each segment, starting with its start, and the end of the last segment.
/// Integrated adaptively (Dormand-Prince, Odeint) to 1e-12, in the units of the states.
std::vector<MotionSample> follow(const SystemInstance& instance, const SystemMotion& motion, int per_segment);

}  // namespace incognita
