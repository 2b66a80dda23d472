// Which gains bring a vehicle nearer although its command is held for a while.
//
// Feedback linearisation makes the control point a single integrator, whose error under w = -K e, sampled
// with period dt, obeys e+ = (I - K dt) e: every eigenvalue of K needs |1 - lambda dt| < 1, and psd, as the
// thesis asks below (5.10), is not enough. That is the model. On the vehicle the body turns while the command
// is held, and the velocity of the point turns with it. Over dt at turn rate w it goes along an arc:
//
//   e+ = e + dt sinc(a) R(a) (-K e),    a = w dt / 2,    sinc(a) = sin(a) / a,    R: rotation by a
//
// exactly, from (3.16) integrated; R stands outside because rotations of the plane commute. |e+| < |e| for
// every e, K symmetric with eigenvalues k1 <= k2, if and only if
//
//   cos(a) (1/k1 + 1/k2) / 2 - (1/k1 - 1/k2) / 2  >  dt sinc(a) / 2
//
// which for K = k I is k dt < 2 a cot(a): the bound 2 of the model at a = 0, and 0 where the body turns by
// half a turn (a = pi/2) in one command. A vehicle whose turn rate is limited to w has |a| <= w dt / 2, and a
// limit that shrinks the whole command only lessens K, so that the worst a decides and the distance to a
// still goal falls at every command, from everywhere. Without such a limit no gain does: w = k e_left / l
// grows with the error, which is how K dt = 1.5 diverged for l = 0.1 m.
//
// What is moved by its acceleration, u = -k_p e - k_v e', is a double integrator. With u held over dt the
// characteristic polynomial is z^2 + (k_p dt^2/2 + k_v dt - 2) z + 1 + k_p dt^2/2 - k_v dt, whose roots are
// inside the unit circle (Jury) if and only if 0 < k_p dt/2 < k_v < 2/dt.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

namespace incognita {

/// 2 a cot(a) / dt with a = max_turn_rate dt / 2: gains k of K = k I have to stay below it (1/s). Not
/// positive where the body may turn by half a turn or more in one command.
double gain_bound_per_s(double max_turn_rate_rad_s, double hold_s);

/// Why this gain (2 x 2, 1/s) is refused for commands that are held for `hold_s` at up to that turn rate:
/// its size, not symmetric and positive definite, too large for a sampled integrator, too large for the
/// vehicle.
std::optional<std::string> gain_refusal(const Eigen::MatrixXd& K, double hold_s, double max_turn_rate_rad_s);

/// Why these gains on an error (1/s^2) and its rate (1/s) are refused for accelerations that are held for
/// `hold_s`: not positive and finite, or the sampled double integrator does not settle.
std::optional<std::string> acceleration_gain_refusal(double by_error, double by_rate, double hold_s);

}  // namespace incognita
