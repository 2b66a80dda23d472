// Example 5.3: two robots, each around a circle of its own, in one belief with their map.
//
// Experiment: closed_loop_run.hpp, the landmarks of Example 5.2; circles of 5 m about (-6, 0) and (6, 0) at 5
// deg/s, as two of 7 m would not lie apart among them; each robot from the center of its circle at heading 0;
// Q2 = 0.5/s I; 80 s, one round takes 72. They measure the landmarks, not each other, as in (5.17). Both
// starts are known to the same sigmas, independently: together they fix the frame. Steady state: from 40 s
// on. The least that a landmark's trace can come to is what the starts leave open of the frame, at its
// position. More robots: on the circle of Example 5.2, evenly apart, 30 s of at most ten seeds.
#include <numbers>

#include "experiments/closed_loop_figures.hpp"
#include "experiments/closed_loop_statistics.hpp"
#include "experiments/common.hpp"
#include "experiments/example_5_2.hpp"
#include "experiments/example_5_3.hpp"
#include "incognita/math/angles.hpp"

namespace incognita {
namespace section_5_3 {

closed_loop::Setup two_circles() {
  closed_loop::Setup s;
  for (const double x : {-6.0, 6.0}) {
    const CirclePath circle{.center = {x, 0, 0}, .radius_m = 5};
    s.robots.push_back(closed_loop::robot({x, 0, 0}, ControlLaw::feedback_linearization, circle));
    s.robots.back().steering.gain_per_s = {section_5_2::gain_per_s};
  }
  s.place = closed_loop::sixteen_landmarks();
  s.duration_s = 80;
  return s;
}

}  // namespace section_5_3

namespace {

using namespace closed_loop;
using section_5_3::two_circles;

constexpr double near_m = 0.5, arrived_by_s = 30, steady_s = 40;

struct Team {
  double arrived_s = 0;                                           ///< the later of the two
  double tracking_rms_m = 0, largest_m = 0, estimated_rms_m = 0;  ///< both robots, in the steady state
  double nees = 0, joint_nees = 0, last_joint_nees = 0;
  double mapped = 0;
  section_5_3::Traces traces = {};
};

void take_tracking(Team& team, const Setup& setup, const Run& run) {
  double squares = 0, estimated = 0;
  int n = 0;
  for (std::size_t robot = 0; robot < setup.robots.size(); ++robot) {
    const Path& path = setup.robots[robot].steering.path;
    const std::vector<double> distances = distances_m(run, path, robot);
    for (std::size_t k = 0; k < distances.size(); ++k) {
      const double t = run.instants[k].t_s;
      if (!(distances[k] < near_m)) team.arrived_s = std::max(team.arrived_s, t + period_s);
      if (t < std::min(steady_s, setup.duration_s / 2)) continue;
      squares += distances[k] * distances[k], ++n;
      estimated +=
          (run.instants[k].robots[robot].mean.head<2>() - at(path, t).position.head<2>()).squaredNorm();
      team.largest_m = std::max(team.largest_m, distances[k]);
    }
    team.nees += mean_nees(run, robot) / static_cast<double>(setup.robots.size());
  }
  team.tracking_rms_m = std::sqrt(squares / n), team.estimated_rms_m = std::sqrt(estimated / n);
}

Team team_of(const Setup& setup, const Run& run) {
  Team team;
  take_tracking(team, setup, run);
  for (const double nees : run.joint_nees)
    team.joint_nees += nees / static_cast<double>(run.joint_nees.size());
  team.last_joint_nees = run.joint_nees.back();
  team.mapped = static_cast<double>(run.map.size());
  return team;
}

Claim converges(const std::vector<Team>& all) {
  const auto there = std::ranges::count_if(all, [](const Team& t) { return t.arrived_s < arrived_by_s; });
  return assessed(
      "5.3-converges", "Example 5.3, Figure 5.9",
      "Both robots come to their circles and follow them, while they map: 95 % of the seeds with both within "
      "0.5 m of where they should be from 30 s on at the latest",
      {.printed = "as accurately as possible",
       .measured = fmt::format("{}, from {:.1f} s on (median). From 40 s on, rms of both: {}; by their own "
                               "estimate {}. The largest of all {:.2f} m",
                               share_text(there, all.size()), quantile(each(all, &Team::arrived_s), 0.5),
                               spread_text(each(all, &Team::tracking_rms_m), "m"),
                               spread_text(each(all, &Team::estimated_rms_m), "m"),
                               quantile(each(all, &Team::largest_m), 1)),
       .seeds = all.size()},
      happens_in(0.95, there, all.size()));
}

Claim consistent(const std::vector<Team>& all) {
  const Interval joint = bootstrap_mean(each(all, &Team::joint_nees)),
                 last = mean_of(each(all, &Team::last_joint_nees)),
                 poses = bootstrap_mean(each(all, &Team::nees));
  return assessed("5.3-consistent", "Figure 5.10, (5.18), (5.19)",
                  "The joint belief of both robots and their map is consistent: mean NEES, over its degrees "
                  "of freedom, within 0.1 of 1",
                  {.measured = fmt::format(
                       "joint NEES {}, at the end {}, {:.1f} of 16 landmarks mapped; of the poses alone {}",
                       text(joint), text(last), mean_of(each(all, &Team::mapped)).value, text(poses)),
                   .seeds = all.size()},
                  agrees(joint, 1, 0.1) && agrees(last, 1, 0.1));
}

Setup team_on_circle(int robots) {
  Setup s;
  for (int i = 0; i < robots; ++i) {
    CirclePath circle = section_5_2::circle;
    circle.phase_rad = 2 * std::numbers::pi * i / robots;
    const Reference start = at(Path(circle), 0);
    s.robots.push_back(robot({start.position.x(), start.position.y(), wrap_angle(start.heading)},
                             ControlLaw::feedback_linearization, circle));
    s.robots.back().steering.gain_per_s = {section_5_2::gain_per_s};
  }
  s.place = sixteen_landmarks();
  s.duration_s = 30;
  return s;
}

Claim any_number(const ExperimentSettings& settings) {
  ExperimentSettings few = settings;
  few.seeds = std::min(settings.seeds, enough_runs);
  const Cases all_follow = by_number({1, 2, 3, 4}, [&](int robots) -> CaseResult {
    const Setup setup = team_on_circle(robots);
    const auto all = over_seeds(few, fmt::format("5.3, {} robots", robots), setup,
                                [&](const Run& run) { return team_of(setup, run); });
    const std::vector<double> tracking = each(all, &Team::tracking_rms_m);
    const Interval nees = mean_of(each(all, &Team::joint_nees));
    return {fmt::format("{:.3f} m, {}", mean_of(tracking).value, text(nees)),
            quantile(tracking, 1) < near_m && is_below(nees, 1.5)};
  });
  return assessed(
      "5.3-any-number", "Section 5.2.1",
      "The extension to a group of vehicles is direct: one to four robots on one circle, each within 0.5 m "
      "of its reference (rms, every seed), joint NEES below 1.5",
      {.printed = "direct",
       .measured = fmt::format("rms from 15 s on and joint NEES by number of robots, {} seeds each: {}",
                               few.seeds, all_follow.text()),
       .seeds = few.seeds},
      all_follow.hold());
}

LedgerEntry run(const ExperimentSettings& settings) {
  const Setup setup = two_circles();
  const std::vector<double> least = section_5_3::least_traces(setup);
  const std::vector<Team> all = over_seeds(settings, "5.3, two circles", setup, [&](const Run& run) {
    Team team = team_of(setup, run);
    team.traces = section_5_3::traces_of(run, least);
    return team;
  });
  std::vector<section_5_3::Traces> traces;
  for (const Team& team : all) traces.push_back(team.traces);
  const Run first = drive(setup, 1);
  return entry_of(example_5_3, settings,
                  concatenated({section_5_3::equation_claims(),
                                section_5_3::estimation_claims(),
                                {converges(all), consistent(all)},
                                section_5_3::map_claims(settings, traces),
                                {any_number(settings)}}),
                  {map_figure("fig-5.9", "Two robots round circles, and SLAM", setup, first),
                   state_figure("fig-5.10", "State estimation and control of two robots", first),
                   section_5_3::traces_figure(first)});
}

}  // namespace

const Experiment example_5_3{
    "5.3", "Two robots around circles while mapping together", {"fig-5.9", "fig-5.10", "fig-5.11"}, run};

}  // namespace incognita
