// Example 5.1: LQG regulation of the vehicle of the plane to a point, while it maps.
//
// Experiment: closed_loop_run.hpp, from (-7, 0), heading 0, which the thesis does not print, to (10, 10) with
// the law (5.6), Q1 = Q2 = I, for 50 s; the path straight to it takes 20 s at the speed limit. The
// eigenvalues are those of F - [G L, 0] of position and heading with the plant's Jacobians at the estimate
// and the input. Holds: 95 % of the seeds within 0.5 m of the point from some moment before 40 s on.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/closed_loop_figures.hpp"
#include "experiments/closed_loop_statistics.hpp"
#include "experiments/evidence.hpp"
#include "experiments/example_5_1.hpp"
#include "experiments/list.hpp"

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
  double arrived_s = 0;                ///< within near_m from then on
  double final_m = 0, believed_m = 0;  ///< from the goal at the end: really, and by the estimate
  double nees = 0;
  Eigen::Array3d within = Eigen::Array3d::Zero();
  double mapped = 0, map_rms_m = 0;
  // Ticks on the way and at the goal, and those of them at which an eigenvalue exceeds 1
  int way = 0, way_above = 0, stay = 0, stay_above = 0;
  int ahead_above = 0,
      back_below = 0;  ///< above 1 while the control point moves forwards, below while backwards
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
  a.believed_m = (run.instants.back().robots[0].mean.head<2>() - Vector2d(10, 10)).norm();
  a.nees = mean_nees(run);
  a.within = share_within_two_sigmas(run);
  a.mapped = static_cast<double>(run.map.size());
  for (const MappedLandmark& l : run.map) a.map_rms_m += (l.truth - l.mean).squaredNorm() / a.mapped;
  a.map_rms_m = std::sqrt(a.map_rms_m);
  return a;
}

Claim arrives(const std::vector<Arrival>& all) {
  const int runs = static_cast<int>(all.size());
  const auto there = static_cast<int>(
      std::count_if(all.begin(), all.end(), [](const Arrival& a) { return a.arrived_s < by_s; }));
  return assessed(
      {.id = "5.1-arrives",
       .place = "Example 5.1, Figure 5.3",
       .statement = "The regulator drives the vehicle from (-7, 0) to (10, 10) while it builds a map: 95 % "
                    "of the seeds are within 0.5 m from 40 s on at the latest",
       .printed = "driven to (10, 10)",
       .measured = fmt::format("{}, from {:.1f} s on (median). At the end: {}; by its own estimate {}; "
                               "{:.1f} of 16 landmarks mapped, {} rms",
                               share_text(there, runs),
                               quantile(each(all, [](const Arrival& a) { return a.arrived_s; }), 0.5),
                               spread_text(each(all, [](const Arrival& a) { return a.final_m; }), "m"),
                               spread_text(each(all, [](const Arrival& a) { return a.believed_m; }), "m"),
                               mean_of(each(all, [](const Arrival& a) { return a.mapped; })).value,
                               text(mean_of(each(all, [](const Arrival& a) { return a.map_rms_m; })), "m")),
       .runs = runs,
       .least_runs = enough_runs},
      happens_in(0.95, static_cast<std::size_t>(there), all.size()));
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
      {.id = "5.1-eigenvalues",
       .place = "below (5.6), Figure 5.5",
       .statement = "The three eigenvalues of F - G L are less than one during the whole simulation time",
       .printed = "less than one",
       .measured = fmt::format(
           "one is above 1 at {:.2f} % of the ticks on the way and at {:.0f} % of those at the goal, up to "
           "{:.4f}; above with the vehicle going forwards {}, not above while it goes backwards {} of {} "
           "ticks. At rest: {:.3f}, {:.3f}, {:.3f}",
           percent(sum.way_above, sum.way), percent(sum.stay_above, sum.stay), sum.largest, sum.ahead_above,
           sum.back_below, sum.way + sum.stay, at_rest[0], at_rest[1], at_rest[2]),
       .why = "the position's two are. The third is the heading's, which the control leaves alone: 1 at "
              "rest, below 1 while the vehicle goes forwards and above 1 while it goes backwards, as it does "
              "half of the time about its goal; a heading that drifts there harms nothing",
       .runs = static_cast<int>(all.size())},
      sum.way_above + sum.stay_above == 0,
      sum.way_above + sum.stay_above > 0 && sum.ahead_above == 0 && sum.back_below == 0 &&
          std::abs(at_rest[0] - 1) < 1e-9 && at_rest[1] < 1 && at_rest[2] < 1);
}

Claim consistent(const std::vector<Arrival>& all) {
  const Interval nees = bootstrap_mean(each(all, [](const Arrival& a) { return a.nees; }));
  Eigen::Array3d within = Eigen::Array3d::Zero();
  for (const Arrival& a : all) within += 100 * a.within / static_cast<double>(all.size());
  return assessed(
      {.id = "5.1-consistent",
       .place = "Figure 5.4",
       .statement = "The estimate stays usable for control: mean NEES of the pose, over its 3 degrees of "
                    "freedom, below 1.2",
       .printed = "",
       .measured = fmt::format(
           "NEES {}; error within two sigmas at {:.1f}, {:.1f}, {:.1f} % of the ticks (x, y, heading)",
           text(nees), within[0], within[1], within[2]),
       .runs = static_cast<int>(all.size()),
       .least_runs = enough_runs},
      is_below(nees, 1.2));
}

LedgerEntry run(const ExperimentSettings& settings) {
  const std::vector<Arrival> all = over_seeds(settings, "5.1, to the goal", setup(), arrival_of);
  LedgerEntry entry{example_5_1.id, example_5_1.title, "", section_5_1::regulator_claims(), {}};
  const auto add = [&](const std::vector<Claim>& claims) {
    entry.claims.insert(entry.claims.end(), claims.begin(), claims.end());
  };
  add(section_5_1::separation_claims(settings, each(all, [](const Arrival& a) { return a.final_m; })));
  add({arrives(all), three_eigenvalues(all), consistent(all)});
  add(section_5_1::vehicle_claims(settings.seeds));
  const Run first = drive(setup(), 1);
  for (const Plot& plot : {map_figure("fig-5.3", "LQG regulation and SLAM", setup(), first),
                           state_figure("fig-5.4", "State estimation and LQG control", first),
                           eigenvalue_figure("fig-5.5", "LQG: eigenvalues of F - G L", first, gain)})
    entry.figures.push_back(draw_plot(settings.out, plot, nullptr));
  return entry;
}

}  // namespace

const Experiment example_5_1{
    "5.1", "LQG regulation to a point while mapping", {"fig-5.3", "fig-5.4", "fig-5.5"}, run};

}  // namespace incognita
