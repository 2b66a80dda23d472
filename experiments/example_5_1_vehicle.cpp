// The law (5.6) on the vehicle whose state is known: when it arrives, and whether another would be cheaper.
//
// Experiment: the vehicle of closed_loop_run.hpp along exact arcs, commands held for 0.1 s. Costs (5.1), Q1 =
// Q2 = I, over 60 s, from the start of Example 5.1 and from (9, 9), where no limit is reached, at eight
// headings; the two rows of L multiplied by factors from 1/4 to 4 each, constant along the path. Noise, where
// there is any, is that of the runs.
#include "experiments/chapter_5_vehicle.hpp"
#include "experiments/closed_loop_statistics.hpp"
#include "experiments/common.hpp"
#include "experiments/example_5_1.hpp"
#include "incognita/control/lqg_regulator.hpp"
#include "incognita/models/motion/planar_frame.hpp"

namespace incognita::section_5_1 {

Matrix2d gain(const planar::Pose<double>& pose) {
  static const Matrix2d ahead = PlanarRegulator({.body = closed_loop::body}).act({0, 0, 0}, {1, 1}).L;
  return ahead * planar::rotation(pose[2]).transpose();
}

namespace {

using closed_loop::body, closed_loop::period_s, closed_loop::Pose;

const Vector2d goal(10, 10);

/// (5.6), its rows multiplied by factors.
Vector2d input(const Pose& pose, const Vector2d& factors) {
  const Vector2d wanted = -(gain(pose) * (pose.head<2>() - goal));
  return limited(wanted.cwiseProduct(factors), closed_loop::body_limits).input();
}

/// (5.1) of one run of 60 s; with `noise` on the inputs.
double cost(Pose pose, const Vector2d& factors, RandomStream* noise = nullptr) {
  double sum = 0;
  for (int k = 0; k < 600; ++k) {
    Vector2d u = input(pose, factors);
    sum += (pose.head<2>() - goal).squaredNorm() + u.squaredNorm();
    if (noise) u += 0.1 * Vector2d(noise->normal(), noise->normal());
    pose = closed_loop::moved(pose, u);
  }
  return sum;
}

struct Cheapest {
  Vector2d factors{1, 1};
  double share = 1;  ///< of what (5.6) costs
};

Cheapest cheapest(const Pose& start) {
  constexpr int grid = 17;
  const double own = cost(start, {1, 1});
  Cheapest best;
  for (int i = 0; i < grid; ++i)
    for (int k = 0; k < grid; ++k) {
      const Vector2d factors(std::exp2(i * 0.25 - 2), std::exp2(k * 0.25 - 2));
      const double share = cost(start, factors) / own;
      if (share < best.share) best = {factors, share};
    }
  return best;
}

/// How much less the cheapest costs, in percent: least and most over eight headings.
Extremes savings(const Vector2d& from) {
  Extremes saved;
  for (int k = 0; k < 8; ++k)
    saved.take(100 * (1 - cheapest({from.x(), from.y(), wrap_angle(k * pi / 4)}).share));
  return saved;
}

Claim optimality(int seeds) {
  constexpr double rounding = 1e-6;  // percent
  const Extremes far = savings({-7, 0}), near = savings({9, 9});
  const Pose start(9, 9, 0);
  const Cheapest best = cheapest(start);
  const double own = cost(start, {1, 1}), most = std::max(far.most, near.most);
  const Interval saved = mean_of(over_seeds(seeds, [&](std::uint64_t seed) {
    RandomStream one(seed, "disturbance"), same = one;
    return 100 * (cost(start, {1, 1}, &one) - cost(start, best.factors, &same)) / own;
  }));
  return assessed(
      "5.1-optimal-vehicle", "below (5.6)",
      "The control strategy is optimal by duality from the EKF: no constant factors on the rows of L make "
      "(5.1) less",
      {.rule = Rule::example,
       .measured = {"rows of L times two constants, at eight headings, without noise: {:.2f} to {:.2f} % "
                    "cheaper from (-7, 0), {:.2f} to {:.2f} % from (9, 9), where no limit is reached; "
                    "disturbed, from (9, 9) ahead, times {:.2f} and {:.2f}: {} of it",
                    far.least, far.most, near.least, near.most, best.factors[0], best.factors[1],
                    text(saved, "%")},
       .number = exactly("saved by the best constant factors, at most", most, "%"),
       .why = "there is no guarantee that it is, as Example 5.1 says itself: (5.3) is the optimum of the "
              "linear system that the vehicle is at one heading, and that moving changes the heading is not "
              "in it. It is less than optimal where no limit is reached and where it is disturbed, too",
       .runs = seeds},
      most <= rounding, in_truth(near.most > rounding && is_above(saved, 0)));
}

/// Without noise, from (-7, 0) at heading 0. The remaining share of the distance per step is taken from 25 s
/// to 35 s: before, limits are active, and later rounding dominates.
Claim finite_time() {
  const closed_loop::Law law = [](const Pose& pose, double) { return input(pose, {1, 1}); };
  const std::vector<double> distances =
      closed_loop::steer(law, {-7, 0, 0}, 35.1).distances_m(PointPath{{10, 10, 0}});
  const auto time_below = [&](double distance) {
    const auto at = std::ranges::find_if(distances, [&](double d) { return d < distance; });
    return period_s * static_cast<double>(at - distances.begin());
  };
  const Extremes left = left_by_steps(distances, 250, 350);
  const Vector3d modes = closed_loop::moduli({0, 0, 0}, {0, 0}, gain({0, 0, 0}));
  return assessed(
      "5.1-finite-time", "Section 5.3", "The first law reaches a desired location in finite time",
      {.rule = Rule::example,
       .measured = {"without noise: within 0.1 m after {:.1f} s, 1 mm after {:.1f} s, 1 um after {:.1f} s; "
                    "from 25 s to 35 s each step leaves {:.4f} to {:.4f} of the distance (modes of the "
                    "position at rest: {:.4f} and {:.4f})",
                    time_below(0.1), time_below(1e-3), time_below(1e-6), left.least, left.most, modes[2],
                    modes[1]},
       .number = exactly("share of the distance that a step leaves", left.most),
       .why = "it comes within any distance in finite time, and never arrives: convergence is asymptotic"},
      distances.back() == 0, in_truth(left.least >= 0.99 * modes[2] && left.most < 1));
}

}  // namespace

std::vector<Claim> vehicle_claims(int seeds) { return {optimality(seeds), finite_time()}; }

}  // namespace incognita::section_5_1
