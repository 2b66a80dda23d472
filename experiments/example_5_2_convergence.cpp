// Which gains Q2 make feedback linearization converge, and whether in finite time: (5.10) and below (5.13).
//
// Experiment: (5.10) itself; the single integrator under commands held for dt, e+ = (I - K dt) e; the vehicle
// along exact arcs, state known, no noise. Of held commands the worst ratio of distances to a still goal over
// one command, over goals for which the turn rate is just at its limit, at gains 2 % below and above the
// bound of control/held_command.hpp.
#include "experiments/common.hpp"
#include "experiments/example_5_2.hpp"
#include "incognita/control/feedback_linearization.hpp"
#include "incognita/control/held_command.hpp"

namespace incognita::section_5_2 {
namespace {

using namespace closed_loop;

/// Largest distance after one held command over that before it, where -k e turns the body at that rate.
double worst_ratio(double k, double hold_s, double turn_rate) {
  double worst = 0;
  for (double forward = -3; forward <= 3; forward += 0.05) {
    const Vector2d velocity(forward, turn_rate * body.forward_m);
    const Pose start(-velocity.x() / k, -velocity.y() / k, 0);
    const Pose end = moved(start, input_for_velocity(body, 0, velocity), hold_s);
    worst = std::max(worst, end.head<2>().norm() / start.head<2>().norm());
  }
  return worst;
}

/// Farthest from the origin of a vehicle of that lever that nothing limits, from 0.3 m beside it, in 20 s.
double farthest_m(double lever_m, double k, double hold_s) {
  const DifferentialDrive vehicle{lever_m, 0};
  Pose pose(0, 0.3, 0);
  double farthest = 0;
  for (int i = 0; i < 200; ++i) {
    pose = moved(pose, input_for_velocity(vehicle, pose[2], -k * pose.head<2>()), hold_s, vehicle);
    farthest = std::max(farthest, pose.head<2>().norm());
  }
  return farthest;
}

Claim gains() {
  constexpr double turn_rate = 1, hold_s = period_s;
  const double bound = gain_bound_per_s(turn_rate, hold_s), slow_bound = gain_bound_per_s(turn_rate, 1);
  const double under = worst_ratio(0.98 * bound, hold_s, turn_rate),
               over = worst_ratio(1.02 * bound, hold_s, turn_rate),
               slow_under = worst_ratio(0.98 * slow_bound, 1, turn_rate),
               slow_over = worst_ratio(1.02 * slow_bound, 1, turn_rate);
  const double left = farthest_m(0.1, 15, hold_s), stays = farthest_m(0.1, 5, hold_s);
  const auto after = [](double factor) { return std::pow(std::abs(factor), 20); };
  const bool when_small =
      under < 1 && over > 1 && slow_under < 1 && slow_over > 1 && left > 0.3 && stays <= 0.3 * (1 + 1e-9);
  return assessed(
      "5.2-gain", "(5.10)", "The error dynamics are asymptotically stable if Q2 is positive semi-definite",
      {.rule = Rule::example,
       .printed = "e_(k+1) + Q2 e_k = 0",
       .measured = {"an error of 1 after 20 steps of (5.10): Q2 = 0.5 I {:.1e}, 2 I {:.1e}. On the vehicle a "
                    "command held for {} s at 1 rad/s leaves of the distance, K 2 % below and above {:.2f} "
                    "1/s, {:.4f} and {:.4f}; for 1 s about {:.3f} 1/s {:.4f} and {:.4f}. Without limits, l = "
                    "0.1 m, from 0.3 m: K dt = 1.5 up to {:.2f} m off",
                    after(0.5), after(2), hold_s, bound, under, over, slow_bound, slow_under, slow_over,
                    left},
       .number = exactly("largest K that converges, held for 0.1 s at 1 rad/s", bound, "1/s"),
       .why =
           "if Q2 is definite and small enough: |1 - lambda dt| < 1 for every eigenvalue, and on the vehicle, "
           "which turns while a command is held, lambda dt < 2 a cot(a), a = w dt / 2 at the largest turn "
           "rate w"},
      after(2) < 1 && after(1) < 1, on_condition(when_small));
}

/// Least and most that a command leaves of the distance, from 20 s to 40 s: before, the limits are in it, and
/// later, rounding.
Extremes left_of(const std::vector<double>& distances) { return left_by_steps(distances, 200, 400); }

Claim finite_time() {
  const Path origin = PointPath{};
  const auto still = follow(origin, {-2, 1, 0}, 60).distances_m(origin),
             moving = follow(circle, {-7, 0, 0}, 60).distances_m(circle);
  const Extremes of_still = left_of(still), of_moving = left_of(moving);
  const double held = 1 - gain_per_s * period_s, left = still[400], behind = moving[400];
  const auto is_factor = [&](const Extremes& e) {
    return std::abs(e.least - held) < 0.01 && std::abs(e.most - held) < 0.01;
  };
  return assessed(
      "5.2-finite-time", "below (5.13)", "The tracking error converges to zero in finite time",
      {.rule = Rule::example,
       .measured = {"without noise: after 40 s {:.1e} m from a point, {:.1e} m on the circle; from 20 s on "
                    "each command leaves {:.4f} to {:.4f} and {:.4f} to {:.4f} of it, 1 - K dt is {:.4f}",
                    left, behind, of_still.least, of_still.most, of_moving.least, of_moving.most, held},
       .number = exactly("share of the distance that a command leaves", of_still.most),
       .why = "it converges asymptotically: each command leaves the same share of the error"},
      left == 0 && behind == 0, in_truth(is_factor(of_still) && is_factor(of_moving)));
}

}  // namespace

std::vector<Claim> convergence_claims() { return {gains(), finite_time()}; }

}  // namespace incognita::section_5_2
