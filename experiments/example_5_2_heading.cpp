// The heading of a vehicle whose position is controlled: it is not controlled, and Figure 5.8 is about it.
//
// Experiment: the vehicle of closed_loop_run.hpp with its state known and no noise, along exact arcs, from
// (-7, 0) at 16 headings; onto the circle for 144 s, and to the point (0, 0) for 60 s. Eigenvalues of F - [G
// L, 0] as in the runs. An eigenvalue counts as above 1 from 1 + 1e-9 on; the error as large from 1 m on.
#include "experiments/closed_loop_statistics.hpp"
#include "experiments/common.hpp"
#include "experiments/example_5_2.hpp"
#include "incognita/control/lqr.hpp"

namespace incognita::section_5_2 {
namespace {

using namespace closed_loop;

constexpr int headings = 16;

Pose start_of(int i) { return {-7, 0, wrap_angle(2 * pi * i / headings)}; }

Claim initial_transient() {
  EigenvalueCount c{.limit = 1 + 1e-9, .backward_m_s = -1e-6};  // more than 1 m off, and nearer
  int headings_above = 0;
  double longest_s = 0;
  for (int i = 0; i < headings; ++i) {
    const Way way = follow(circle, start_of(i), two_rounds_s);
    const int above_before = c.away_above + c.there_above;
    for (std::size_t k = 0; k < way.poses.size(); ++k)
      c.take(moduli(way.poses[k], way.inputs[k], gain(way.poses[k]))[0], way.inputs[k][0],
             !(way.distance_m(circle, k) > 1));
    const int above = c.away_above + c.there_above - above_before;
    headings_above += above > 0;
    longest_s = std::max(longest_s, period_s * above);
  }
  return assessed(
      "5.2-eigenvalues", "above and in Figure 5.8",
      "While the tracking error is large at first the error dynamics are not stable; once the vehicle is "
      "near its path they are",
      {.rule = Rule::example,
       .measured = {"from (-7, 0) at {} headings: an eigenvalue above 1 at {} of {} ticks more than 1 m off, "
                    "at {} of {} nearer; up to {:.4f}, for at most {:.1f} s; from {} of the headings. With "
                    "the vehicle moving forward {} times, moving backward and none above 1 {} times",
                    headings, c.away_above, c.away, c.there_above, c.there, c.largest, longest_s,
                    headings_above, c.ahead_above, c.back_below},
       .number =
           exactly("ticks more than 1 m off with an eigenvalue above 1", 100.0 * c.away_above / c.away, "%"),
       .why = "stable near the path, yes; at first it is not the size of the error that makes it unstable, "
              "but moving backward: the heading turns away from the direction of motion until the vehicle "
              "has turned around"},
      c.away_above == c.away && c.there_above == 0,
      in_truth(c.away_above > 0 && c.away_above < c.away && c.there_above == 0 && c.ahead_above == 0 &&
               c.back_below == 0));
}

Claim whole_pose() {
  const Matrix3d F = body.step({0, 0, 0.3}, {0, 0}, period_s).F;
  const MatrixXd G = body.step({0, 0, 0.3}, {0, 0}, period_s).G;
  const SteadyGain regulator = steady_gain(F, G, MatrixXd::Identity(3, 3), MatrixXd::Identity(2, 2));
  double farthest = 0;
  Extremes turned;
  for (int i = 0; i < headings; ++i) {
    const Pose end = follow(PointPath{}, start_of(i), 60).poses.back();
    farthest = std::max(farthest, end.head<2>().norm());
    turned.take(end[2]);
  }
  return assessed(
      "5.2-whole-pose", "below Figure 5.8, with [17]",
      "The whole pose of this vehicle cannot be stabilized (at a point, by a linear law of its "
      "inputs); its position can, and the final heading is free",
      {.rule = Rule::example,
       .measured = {"regulator of the pose at rest: {}. From {} headings, after 60 s: at most "
                    "{:.1e} m from the point, with headings from {:.0f} to {:.0f} deg",
                    sentence(regulator.outcome), headings, farthest, degrees(turned.least),
                    degrees(turned.most)},
       .number = exactly("spread of the final headings", degrees(turned.most - turned.least), "degrees")},
      regulator.outcome == RegulatorOutcome::not_stabilizable && farthest < 1e-3 &&
          turned.most - turned.least > radians(20));
}

Claim free_heading() {
  double worst = 0, spread = 0, first = 0;
  for (int i = 0; i < headings; ++i) {
    const Way way = follow(circle, start_of(i), two_rounds_s);
    worst = std::max(worst, std::ranges::max(way.distances_m(circle, second_round)));
    if (i == 0) first = way.poses.back()[2];
    spread = std::max(spread, std::abs(wrap_angle(way.poses.back()[2] - first)));
  }
  return assessed("5.2-free-heading", "below Figure 5.8",
                  "With the position controlled only and the heading free the path is still followed "
                  "accurately after a transient: within 1 cm in the second round from every heading, and the "
                  "heading becomes the path's (the same from all, to 1e-6 rad)",
                  {.measured = {"from {} headings at most {:.1f} mm off in the second round; headings at the "
                                "end differ, in rad, {}",
                                headings, 1000 * worst, below(spread)}},
                  worst < 0.01 && spread < 1e-6);
}

}  // namespace

std::vector<Claim> heading_claims() { return {initial_transient(), whole_pose(), free_heading()}; }

}  // namespace incognita::section_5_2
