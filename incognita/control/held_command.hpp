// Gains for which a vehicle converges although its command is held for a while.
//
// Feedback linearization makes the control point a single integrator. Under w = -K e, sampled with period dt,
// its error obeys e+ = (I - K dt) e: every eigenvalue of K needs |1 - lambda dt| < 1, and K psd, as the
// thesis asks below (5.10), is not sufficient. This is the model. On the vehicle the body turns while the
// command is held, and the velocity of the point turns with it. Over dt at turn rate w the point moves along
// an arc:
//
//     e+ = e + dt sinc(a) R(a) (-K e),    a = w dt / 2,    sinc(a) = sin(a) / a,    R: rotation by a
//
// which is exact, from (3.16) integrated; R stands outside because planar rotations commute. |e+| < |e| for
// every e, with K symmetric with eigenvalues k1 <= k2, if and only if
//
//     cos(a) (1/k1 + 1/k2) / 2 - (1/k1 - 1/k2) / 2  >  dt sinc(a) / 2
//
// For K = k I this is k dt < 2 a cot(a): the bound 2 of the model at a = 0, and 0 if the body makes half a
// turn (a = pi/2) during one command. A turn rate limit w implies |a| <= w dt / 2, and scaling down the whole
// command only reduces K, so the largest a is the worst case, and the distance to a fixed goal decreases at
// every command from every start. Without a turn rate limit no gain suffices: w = k e_left / l grows with the
// error, which is how K dt = 1.5 diverged for l = 0.1 m.
//
// A body controlled by its acceleration, u = -k_p e - k_v e', is a double integrator. With u held over dt the
// characteristic polynomial is z^2 + (k_p dt^2/2 + k_v dt - 2) z + 1 + k_p dt^2/2 - k_v dt, whose roots lie
// inside the unit circle (Jury) if and only if 0 < k_p dt/2 < k_v < 2/dt.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

#include "incognita/messages/unfit_setting.hpp"

namespace incognita {

/// Upper bound of the gain k of K = k I, 1/s: 2 a cot(a) / dt with a = max_turn_rate dt / 2. Not positive if
/// the body may make half a turn or more during one command.
double gain_bound_per_s(double max_turn_rate_rad_s, double hold_s);

/// Reason why the gain K (1/s) is invalid for commands held for `hold_s` at up to that turn rate: not 2 x 2, not
/// symmetric positive definite, or too large for the sampled integrator or for the vehicle. Empty if valid.
std::optional<UnfitSetting> gain_refusal(const Eigen::MatrixXd& K, double hold_s, double max_turn_rate_rad_s);

/// Reason why these gains on an error (1/s^2) and its rate (1/s) are invalid for accelerations held for
/// `hold_s`: not positive and finite, or an unstable sampled double integrator. Empty if valid.
std::optional<std::string> acceleration_gain_refusal(double by_error, double by_rate, double hold_s);

}  // namespace incognita
