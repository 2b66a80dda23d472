// Over which range a linear controller serves: head of Section 5.2.
//
// Experiment: the vehicle of closed_loop_run.hpp with its state known and no noise, along exact arcs, to a
// point 0.01, 20 and 200 m away in 64 directions, heading 0 at first, within the limits. The regulator (5.6),
// linearized at every step as in Example 5.1; the same with the gain that it has at the start, as a linear
// controller has it; feedback linearization. It is there from when on it stays within 1 % of the distance, or
// 0.1 m where that is less; time is given as the way takes twice, and a minute.
#include "experiments/closed_loop_statistics.hpp"
#include "experiments/common.hpp"
#include "experiments/example_5_1.hpp"
#include "experiments/example_5_2.hpp"
#include "experiments/paired_factor.hpp"
#include "incognita/control/feedback_linearization.hpp"

namespace incognita::section_5_2 {
namespace {

using namespace closed_loop;

constexpr int directions = 64;

enum class Regulator { linearized_anew, of_the_start, feedback_linearization };

Law law_to_origin(Regulator which) {
  return [which](const Pose& pose, double) -> Vector2d {
    const Vector2d y = pose.head<2>();
    if (which == Regulator::feedback_linearization) return -(gain(pose) * y);
    const Pose at = which == Regulator::of_the_start ? Pose(0, 0, 0) : pose;
    return -(section_5_1::gain(at) * y);
  };
}

/// When it is there, for each direction; infinite where it is not.
std::vector<double> arrivals_s(Regulator which, double range_m) {
  const double near = std::min(0.01 * range_m, 0.1), duration_s = 60 + 2 * range_m / top_speed_m_s;
  std::vector<double> times;
  for (int i = 0; i < directions; ++i) {
    const double angle = 2 * pi * i / directions;
    const Way way =
        steer(law_to_origin(which), {range_m * std::cos(angle), range_m * std::sin(angle), 0}, duration_s);
    std::size_t k = way.poses.size();
    while (k > 0 && way.poses[k - 1].head<2>().norm() < near) --k;
    times.push_back(k < way.poses.size() ? period_s * static_cast<double>(k)
                                         : std::numeric_limits<double>::infinity());
  }
  return times;
}

std::ptrdiff_t there(const std::vector<double>& arrivals) {
  return std::ranges::count_if(arrivals, [](double t) { return std::isfinite(t); });
}

Claim linear_range() {
  Cases all;
  std::ptrdiff_t astray_far = 0;
  Answer poor = false, kept_fails = true;
  for (const double range_m : {0.01, 20.0, 200.0}) {
    const auto anew = arrivals_s(Regulator::linearized_anew, range_m),
               kept = arrivals_s(Regulator::of_the_start, range_m),
               exact = arrivals_s(Regulator::feedback_linearization, range_m);
    const bool small = range_m < 1, arrives = there(anew) == directions && there(exact) == directions;
    const Interval slower = arrives ? factor(anew, exact) : Interval{NAN, NAN, NAN};
    all.add({{"{} m: {}, {}, {}{}", range_m, there(kept), there(anew), there(exact),
              small ? "" : "; anew it takes " + text(slower, "times as long as the last")}});
    if (small) {
      kept_fails = kept_fails && there(kept) == directions;  // within its range it serves
    } else {
      poor =
          poor || happens_in(0.5, directions - there(anew), directions) || is_above(slower, as_good_factor);
      kept_fails = kept_fails && happens_in(0.5, directions - there(kept), directions);
      astray_far = directions - there(kept);
    }
  }
  return assessed(
      "5.2-linear-range", "head of Section 5.2",
      "Over a large range a linear controller is likely to perform poorly or becomes unstable: from 20 or 200 "
      "m the regulator does not arrive from more than half of the directions, or takes longer than feedback "
      "linearization by a factor of 1.25 or more",
      {.rule = Rule::frequency,
       .measured = {"arrived, of {} directions, by the gain of the start, linearized anew, and by feedback "
                    "linearization: {}",
                    directions, all.text()},
       .number = share_number("directions from which the gain of the start does not lead there from 200 m",
                              astray_far, directions),
       .why = "of a controller that is linear, with its gain kept: it serves from 1 cm and fails from more "
              "than half of the directions from afar. The regulator of Example 5.1, which is linearized "
              "anew at every step, arrives from everywhere, about as fast as feedback linearization",
       .runs = directions},
      poor, on_condition(kept_fails));
}

}  // namespace

std::vector<Claim> range_claims() { return {linear_range()}; }

}  // namespace incognita::section_5_2
