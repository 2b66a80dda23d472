// Example 5.3: two robots, each around a circle of its own, in one belief with their map.
//
// Experiment: closed_loop_run.hpp, the landmarks of Example 5.2; circles of 5 m about (-6, 0) and (6, 0) at 5
// deg/s, as two of 7 m would not lie apart among them; each robot from the center of its circle at heading 0;
// Q2 = 0.5/s I; 80 s, one round takes 72. They measure the landmarks, not each other, as in (5.17). Both
// starts are known to the same sigmas, independently: together they fix the frame. Steady state: from 40 s
// on. The least that a landmark's trace can come to is what the starts leave open of the frame, at its
// position. More robots: on the circle of Example 5.2, evenly apart, 30 s of at most ten seeds.
#include "experiments/example_5_3.hpp"
#include "experiments/closed_loop_figures.hpp"
#include "experiments/closed_loop_statistics.hpp"
#include "experiments/common.hpp"
#include "experiments/example_5_2.hpp"

namespace incognita {
namespace section_5_3 {

closed_loop::Setup two_circles() {
  const auto around = [](double x) {
    return section_5_2::robot({x, 0, 0}, CirclePath{.center = {x, 0, 0}, .radius_m = 5});
  };
  return {.robots = {around(-6), around(6)}, .duration_s = 80};
}

}  // namespace section_5_3

namespace {

using namespace closed_loop;
using section_5_3::two_circles;

/// The later of the two.
double both_arrived_s(const Run& run) {
  double last = 0;
  for (std::size_t i = 0; i < 2; ++i)
    last = std::max(last, arrived_s(run, two_circles().robots[i].steering.path, i));
  return last;
}

Claim converges(const Runs& runs) {
  std::vector<Tracking> steady;
  for (const Run& run : runs) steady.push_back(tracking(two_circles(), run, 40));
  return arrive_by(30, each(runs, both_arrived_s), "5.3-converges", "Example 5.3, Figure 5.9",
                   "Both robots come to their circles and follow them, while they map: 95 % of the seeds "
                   "with both within 0.5 m of where they should be from 30 s on at the latest",
                   text(steady, "From 40 s on, rms of both", "their"));
}

double joint_nees(const Run& run) { return mean_of(run.joint_nees).value; }

Claim consistent(const Runs& runs) {
  const auto at_end = [](const Run& run) { return run.joint_nees.back(); };
  const auto of_poses = [](const Run& run) { return (mean_nees(run, 0) + mean_nees(run, 1)) / 2; };
  const auto mapped = [](const Run& run) { return static_cast<double>(run.map.size()); };
  const Interval joint = bootstrap_mean(each(runs, joint_nees)), last = mean_of(each(runs, at_end)),
                 poses = bootstrap_mean(each(runs, of_poses));
  return assessed(
      "5.3-consistent", "Figure 5.10, (5.18), (5.19)",
      "The joint belief of both robots and their map is consistent: mean NEES, over its degrees of freedom, "
      "within 0.2 of 1",
      {.rule = Rule::equality,
       .measured = {"joint NEES {}, at the end {}, {:.1f} of 16 landmarks mapped; of the poses alone {}",
                    text(joint), text(last), mean_of(each(runs, mapped)).value, text(poses)},
       .number = ClaimNumber{"joint NEES of both robots and their map", joint},
       .seeds = runs.size()},
      is_consistent(joint) && is_consistent(last));
}

Setup team_on_circle(int robots) {
  Setup s;
  s.duration_s = 30;
  for (int i = 0; i < robots; ++i) {
    CirclePath circle = section_5_2::circle;
    circle.phase_rad = 2 * pi * i / robots;
    const Reference start = at(Path(circle), 0);
    s.robots.push_back(
        section_5_2::robot({start.position.x(), start.position.y(), wrap_angle(start.heading)}, circle));
  }
  return s;
}

Claim any_number(const ExperimentSettings& settings) {
  Interval last_off_m;  // of four robots
  const Cases all_follow = by_number({1, 2, 3, 4}, [&](int robots) -> CaseResult {
    const Setup setup = team_on_circle(robots);
    const Runs runs = runs_of(few(settings), fmt::format("5.3, {} robots", robots), setup);
    const auto off_m = each(runs, [&](const Run& run) { return tracking(setup, run, 15).rms_m; });
    const Interval nees = mean_of(each(runs, joint_nees));
    last_off_m = mean_of(off_m);
    return {{"{:.3f} m, {}", last_off_m.value, text(nees)},
            quantile(off_m, 1) < near_m && is_consistent(nees)};
  });
  return assessed(
      "5.3-any-number", "Section 5.2.1",
      "The extension to a group of vehicles is direct: one to four robots on one circle, each "
      "within 0.5 m of its reference (rms, every seed), joint NEES within 0.2 of 1",
      {.rule = Rule::equality,
       .measured = {"rms from 15 s on and joint NEES by number of robots, {} seeds each: {}",
                    few(settings).seeds, all_follow.text()},
       .number = ClaimNumber{"rms distance of four robots from their references", last_off_m, "m"},
       .seeds = few(settings).seeds},
      all_follow.hold());
}

LedgerEntry run_example_5_3(const ExperimentSettings& settings) {
  const Runs runs = runs_of(settings, "5.3, two circles", two_circles());
  const Run& first = runs.front();
  return entry_of(example_5_3, settings,
                  {section_5_3::equation_claims(), section_5_3::estimation_claims(), converges(runs),
                   consistent(runs), section_5_3::map_claims(settings, runs), any_number(settings)},
                  {map_figure("fig-5.9", "Two robots round circles, and SLAM", two_circles(), first),
                   state_figure("fig-5.10", "State estimation and control of two robots", first),
                   section_5_3::traces_figure(first)});
}

}  // namespace

const Experiment example_5_3{"5.3",
                             "Two robots around circles while mapping together",
                             {"fig-5.9", "fig-5.10", "fig-5.11"},
                             run_example_5_3};

}  // namespace incognita
