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
namespace {

using namespace closed_loop;
using Eigen::Vector2d;
using section_5_1::gain;

const Path to_goal = PointPath{{10, 10, 0}};
constexpr double near_m = 0.5, by_s = 40;

Setup setup() {
  Setup s;
  s.robots = {robot({-7, 0, 0}, ControlLaw::lqg, to_goal)};
  s.place = sixteen_landmarks();
  s.duration_s = 50;
  return s;
}

struct Arrival {
  double arrived_s = 0;                 ///< within near_m from then on
  double final_m = 0, estimated_m = 0;  ///< from the goal at the end: really, and by the estimate
  double nees = 0;
  Eigen::Array3d within = Eigen::Array3d::Zero();
  double mapped = 0, map_rms_m = 0;
  // Ticks before arrival and at the goal, and those of them at which an eigenvalue exceeds 1
  int way = 0, way_above = 0, stay = 0, stay_above = 0;
  int ahead_above = 0,
      back_below = 0;  ///< above 1 while the control point moves forward, below while backward
  double largest = 0;
};

void take_eigenvalues(Arrival& a, const RobotInstant& r, bool arrived) {
  const double largest = moduli(r, gain(r.mean))[0];
  const double ahead = r.input[0];  // of the axle, and of a point straight before it
  const bool above = largest > 1;
  (arrived ? a.stay : a.way) += 1;
  (arrived ? a.stay_above : a.way_above) += above;
  a.ahead_above += above && ahead > 0;
  a.back_below += !above && ahead < 0;
  a.largest = std::max(a.largest, largest);
}

Arrival arrival_of(const Run& run) {
  Arrival a;
  const std::vector<double> distances = distances_m(run, to_goal);
  for (std::size_t k = 0; k < distances.size(); ++k) {
    if (!(distances[k] < near_m)) a.arrived_s = run.instants[k].t_s + period_s;
  }
  for (const Instant& i : run.instants) take_eigenvalues(a, i.robots[0], i.t_s >= a.arrived_s);
  a.final_m = distances.back();
  a.estimated_m = (run.instants.back().robots[0].mean.head<2>() - Vector2d(10, 10)).norm();
  a.nees = mean_nees(run);
  a.within = share_within_two_sigmas(run);
  a.mapped = static_cast<double>(run.map.size());
  for (const MappedLandmark& l : run.map) a.map_rms_m += (l.truth - l.mean).squaredNorm() / a.mapped;
  a.map_rms_m = std::sqrt(a.map_rms_m);
  return a;
}

Claim arrives(const std::vector<Arrival>& all) {
  const auto there = std::ranges::count_if(all, [](const Arrival& a) { return a.arrived_s < by_s; });
  return assessed(
      "5.1-arrives", "Example 5.1, Figure 5.3",
      "The regulator drives the vehicle from (-7, 0) to (10, 10) while it builds a map: 95 % of the seeds "
      "are within 0.5 m from 40 s on at the latest",
      {.printed = "driven to (10, 10)",
       .measured = fmt::format(
           "{}, from {:.1f} s on (median). At the end: {}; by its own estimate {}; {:.1f} of 16 landmarks "
           "mapped, {} rms",
           share_text(there, all.size()), quantile(each(all, &Arrival::arrived_s), 0.5),
           spread_text(each(all, &Arrival::final_m), "m"), spread_text(each(all, &Arrival::estimated_m), "m"),
           mean_of(each(all, &Arrival::mapped)).value, text(mean_of(each(all, &Arrival::map_rms_m)), "m")),
       .seeds = all.size()},
      happens_in(0.95, there, all.size()));
}

Claim three_eigenvalues(const std::vector<Arrival>& all) {
  Arrival sum;
  for (const Arrival& a : all) {
    sum.way += a.way, sum.way_above += a.way_above, sum.stay += a.stay, sum.stay_above += a.stay_above;
    sum.ahead_above += a.ahead_above, sum.back_below += a.back_below;
    sum.largest = std::max(sum.largest, a.largest);
  }
  RobotInstant rest{{0, 0, 0}, {0, 0, 0}, Eigen::Matrix3d::Zero(), {0, 0}};
  const Eigen::Vector3d at_rest = moduli(rest, gain(rest.mean));
  const auto percent = [](int part, int whole) { return whole > 0 ? 100.0 * part / whole : 0.0; };
  return assessed(
      "5.1-eigenvalues", "below (5.6), Figure 5.5",
      "The three eigenvalues of F - G L are less than one during the whole simulation time",
      {.printed = "less than one",
       .measured = fmt::format(
           "one is above 1 at {:.2f} % of the ticks before arrival and at {:.0f} % of those at the goal, up "
           "to {:.4f}; above with the vehicle moving forward {}, not above while it moves backward {} of {} "
           "ticks. At rest: {:.3f}, {:.3f}, {:.3f}",
           percent(sum.way_above, sum.way), percent(sum.stay_above, sum.stay), sum.largest, sum.ahead_above,
           sum.back_below, sum.way + sum.stay, at_rest[0], at_rest[1], at_rest[2]),
       .why = "the position's two are. The third is the heading's, which the control leaves alone: 1 at "
              "rest, below 1 while the vehicle moves forward and above 1 while it moves backward, as it does "
              "half of the time around its goal; a drifting heading does no harm there",
       .runs = all.size()},
      sum.way_above + sum.stay_above == 0,
      sum.way_above + sum.stay_above > 0 && sum.ahead_above == 0 && sum.back_below == 0 &&
          std::abs(at_rest[0] - 1) < 1e-9 && at_rest[1] < 1 && at_rest[2] < 1);
}

Claim consistent(const std::vector<Arrival>& all) {
  std::vector<Eigen::Array3d> within;
  for (const Arrival& a : all) within.push_back(a.within);
  return consistent_enough("5.1-consistent", "Figure 5.4", each(all, &Arrival::nees), within);
}

LedgerEntry run(const ExperimentSettings& settings) {
  const std::vector<Arrival> all = over_seeds(settings, "5.1, to the goal", setup(), arrival_of);
  const auto final_m = each(all, &Arrival::final_m);
  const Run first = drive(setup(), 1);
  return entry_of(example_5_1, settings,
                  concatenated({section_5_1::regulator_claims(),
                                section_5_1::separation_claims(settings, final_m),
                                {arrives(all), three_eigenvalues(all), consistent(all)},
                                section_5_1::vehicle_claims(settings.seeds)}),
                  {map_figure("fig-5.3", "LQG regulation and SLAM", setup(), first),
                   state_figure("fig-5.4", "State estimation and LQG control", first),
                   eigenvalue_figure("fig-5.5", "LQG: eigenvalues of F - G L", first, gain)});
}

}  // namespace

const Experiment example_5_1{
    "5.1", "LQG regulation to a point while mapping", {"fig-5.3", "fig-5.4", "fig-5.5"}, run};

}  // namespace incognita
