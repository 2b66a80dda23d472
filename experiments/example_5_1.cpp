// Example 5.1: LQG regulation of the planar vehicle to a point, while it maps.
//
// Experiment: closed_loop_run.hpp, from (-7, 0), heading 0, which the thesis does not print, to (10, 10) with
// the law (5.6), Q1 = Q2 = I, for 50 s; the path straight to it takes 20 s at the speed limit. The
// eigenvalues are those of F - [G L, 0] of position and heading with the plant's Jacobians at the estimate
// and the input. Holds: 95 % of the seeds within 0.5 m of the point from some moment before 40 s on.
#include "experiments/example_5_1.hpp"
#include "experiments/closed_loop_figures.hpp"
#include "experiments/closed_loop_statistics.hpp"
#include "experiments/common.hpp"

namespace incognita {

closed_loop::Setup section_5_1::example_setup() {
  return {.robots = {closed_loop::robot({-7, 0, 0}, ControlLaw::lqg, to_goal)}, .duration_s = 50};
}

namespace {

using namespace closed_loop;
using section_5_1::example_setup, section_5_1::gain, section_5_1::to_goal;

double arrived(const Run& run) { return arrived_s(run, to_goal); }
double final_m(const Run& run) { return distances_m(run, to_goal).back(); }
double estimated_final_m(const Run& run) {
  return (run.instants.back().robots[0].mean.head<2>() - Vector2d(10, 10)).norm();
}
double mapped(const Run& run) { return static_cast<double>(run.map.size()); }
double map_rms_m(const Run& run) {
  return rms_of(each(run.map, [](const MappedLandmark& l) { return (l.truth - l.mean).norm(); })).value;
}

Claim arrives(const Runs& runs) {
  return arrive_by(
      40, each(runs, arrived), "5.1-arrives", "Example 5.1, Figure 5.3",
      "The regulator drives the vehicle from (-7, 0) to (10, 10) while it builds a map: 95 % of the seeds "
      "are within 0.5 m from 40 s on at the latest",
      fmt::format("At the end: {}; by its own estimate {}; {:.1f} of 16 landmarks mapped, {} rms",
                  spread_text(each(runs, final_m), "m"), spread_text(each(runs, estimated_final_m), "m"),
                  mean_of(each(runs, mapped)).value, text(mean_of(each(runs, map_rms_m)), "m")));
}

Claim three_eigenvalues(const Runs& runs) {
  EigenvalueCount ticks;            // away from the goal, and there
  std::vector<double> above_there;  // percent, by run
  for (const Run& run : runs) {
    const double there_s = arrived(run);
    const int before = ticks.there_above, ticks_before = ticks.there;
    for (const Instant& i : run.instants) {
      const RobotInstant& r = i.robots[0];
      ticks.take(moduli(r, gain(r.mean))[0], r.input[0], i.t_s >= there_s);
    }
    if (ticks.there > ticks_before)
      above_there.push_back(100.0 * (ticks.there_above - before) / (ticks.there - ticks_before));
  }
  const Vector3d at_rest = moduli({0, 0, 0}, {0, 0}, gain({0, 0, 0}));
  const auto percent = [](int part, int whole) { return whole > 0 ? 100.0 * part / whole : 0.0; };
  const int above = ticks.away_above + ticks.there_above;
  return assessed(
      "5.1-eigenvalues", "below (5.6), Figure 5.5",
      "The three eigenvalues of F - G L are less than one during the whole simulation time",
      {.rule = Rule::example,
       .measured = {"one is above 1 at {:.2f} % of the ticks before arrival and at {:.0f} % of those at the "
                    "goal, up to {:.4f}; above with the vehicle moving forward {}, not above while it moves "
                    "backward {} of {} ticks. At rest: {:.3f}, {:.3f}, {:.3f}",
                    percent(ticks.away_above, ticks.away), percent(ticks.there_above, ticks.there),
                    ticks.largest, ticks.ahead_above, ticks.back_below, ticks.away + ticks.there, at_rest[0],
                    at_rest[1], at_rest[2]},
       .number =
           ClaimNumber{"ticks at the goal with an eigenvalue above 1", bootstrap_mean(above_there), "%"},
       .why = "the position's two are. The third is the heading's, which the control leaves alone: 1 at "
              "rest, below 1 while the vehicle moves forward and above 1 while it moves backward, as it does "
              "half of the time around its goal",
       .runs = runs.size()},
      above == 0,
      in_truth(ticks.ahead_above == 0 && ticks.back_below == 0 && std::abs(at_rest[0] - 1) < 1e-9 &&
               at_rest[1] < 1 && at_rest[2] < 1));
}

LedgerEntry run_example_5_1(const ExperimentSettings& settings) {
  const Runs runs = runs_of(settings, "5.1, to the goal", example_setup());
  const Run& first = runs.front();
  return entry_of(
      example_5_1, settings,
      {section_5_1::regulator_claims(), section_5_1::separation_claims(settings),
       section_5_1::control_claims(settings, runs), arrives(runs), three_eigenvalues(runs),
       consistent_enough("5.1-consistent", "Figure 5.4", runs), section_5_1::vehicle_claims(settings.seeds)},
      {map_figure("fig-5.3", "LQG regulation and SLAM", example_setup(), first),
       state_figure("fig-5.4", "State estimation and LQG control", first),
       eigenvalue_figure("fig-5.5", "LQG: eigenvalues of F - G L", first, gain)});
}

}  // namespace

const Experiment example_5_1{
    "5.1", "LQG regulation to a point while mapping", {"fig-5.3", "fig-5.4", "fig-5.5"}, run_example_5_1};

}  // namespace incognita
