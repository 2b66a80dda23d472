// Example 5.2: the planar vehicle around a circle by feedback linearization, while it maps.
//
// Experiment: closed_loop_run.hpp; circle (5.14) of 7 m at 5 deg/s, the reference at (7, 0) at first; the law
// of control/feedback_linearization.hpp with Q2 = 0.5/s I, for 100 s. The thesis prints no start: (-7, 0) as
// in Example 5.1, facing away from the path's start, so that what it says of the first seconds can be seen;
// and (7, 0) along the path. The robot has arrived when it stays within 0.5 m of the reference from then on;
// the last 50 s are the steady state.
#include "experiments/example_5_2.hpp"
#include "experiments/closed_loop_figures.hpp"
#include "experiments/closed_loop_statistics.hpp"
#include "experiments/common.hpp"
#include "experiments/paired_factor.hpp"
#include "experiments/unaffected_control.hpp"

namespace incognita {
namespace {

using namespace closed_loop;
using section_5_2::circle;

constexpr double steady_s = 50;

Setup setup(const planar::Pose<double>& start, double duration_s = 100) {
  return {.robots = {section_5_2::robot(start, circle)}, .duration_s = duration_s};
}

const Setup facing_away = setup({-7, 0, pi}), on_path = setup({7, 0, pi / 2}, 30);

double arrived(const Run& run) { return arrived_s(run, circle); }

Claim converges(const Runs& runs) {
  std::vector<Tracking> steady;
  for (const Run& run : runs) steady.push_back(tracking(facing_away, run, steady_s));
  return arrive_by(40, each(runs, arrived), "5.2-converges", "Example 5.2, Figure 5.6",
                   "The vehicle comes to the circle and follows it, while it maps: 95 % of the seeds within "
                   "0.5 m of where they should be from 40 s on at the latest",
                   text(steady, "In the last 50 s, rms", "its"));
}

double speed_m_s(const Instant& i) { return i.robots[0].input[0]; }
double turn_deg_s(const Instant& i) { return degrees(i.robots[0].input[1]); }

Claim steady_state(const Runs& runs) {
  const auto in_steady_state = [&](double of(const Instant&)) {
    return mean_of(
        each(runs, [&](const Run& run) { return mean_of(over_ticks(run, of, {.from_s = steady_s})).value; }));
  };
  const Interval speed = in_steady_state(speed_m_s), turn = in_steady_state(turn_deg_s);
  return assessed("5.2-steady-state", "Example 5.2, Figure 5.7",
                  "Speed and turn rate settle around 0.6 m/s and 5 deg/s: means of the last 50 s within 0.05 "
                  "m/s and 0.1 deg/s",
                  {.rule = Rule::equality,
                   .printed = "0.6 m/s, 5 deg/s",
                   .measured = {"{}, {}; r w is {:.4f} m/s, of the axle then {:.4f}", text(speed, "m/s"),
                                text(turn, "deg/s"), circle.radius_m * circle.rate_rad_s,
                                circle.rate_rad_s *
                                    std::sqrt(std::pow(circle.radius_m, 2) - std::pow(body.forward_m, 2))},
                   .number = ClaimNumber{"speed in the last 50 s", speed, "m/s"},
                   .seeds = runs.size()},
                  agrees(speed, 0.6, 0.05) && agrees(turn, 5, 0.1));
}

std::ptrdiff_t count_above(const std::vector<double>& samples, double bound) {
  return std::ranges::count_if(samples, [&](double x) { return x > bound; });
}

double percent_saturated(const Run& run) {
  const auto saturated = [](const Instant& i) { return std::abs(speed_m_s(i)) > top_speed_m_s - 1e-9; };
  return 100 * mean_of(over_ticks(run, saturated, {.until_s = arrived(run)})).value;
}

Claim saturated(const Runs& runs) {
  const std::vector<double> shares = each(runs, percent_saturated);
  const auto first_error_m = [](const Run& run) { return distances_m(run, circle).front(); };
  return assessed("5.2-saturated", "Example 5.2, Figure 5.7",
                  "At first the law chooses a saturated speed to reach the path: at more than half of the "
                  "ticks until it is there, in 95 % of the seeds",
                  {.rule = Rule::frequency,
                   .measured = {"{:.1f} m off at first; at the limit of {} m/s at a share of ticks of median "
                                "{:.0f} %, in 95 % of the seeds above {:.0f} %",
                                quantile(each(runs, first_error_m), 0.5), top_speed_m_s,
                                quantile(shares, 0.5), quantile(shares, 0.05)},
                   .number = share_number("runs at the limit for more than half of the way",
                                          count_above(shares, 50), runs.size()),
                   .seeds = runs.size()},
                  happens_in(0.95, count_above(shares, 50), runs.size()));
}

Claim turn_rate(const Runs& runs) {
  const auto rms_from_5 = [&](const Span& span) {
    const auto off = [](const Instant& i) { return turn_deg_s(i) - 5; };
    return each(runs, [&](const Run& run) { return rms_of(over_ticks(run, off, span)).value; });
  };
  const std::vector<double> early = rms_from_5({.until_s = 10}), late = rms_from_5({.from_s = steady_s});
  std::vector<double> ratios;
  for (std::size_t i = 0; i < early.size(); ++i) ratios.push_back(early[i] / late[i]);
  return assessed(
      "5.2-turn-rate", "Example 5.2, Figure 5.7",
      "The turn rate fluctuates drastically at first and then settles: its rms from 5 deg/s is more than "
      "three times as large in the first 10 s as in the last 50 s, in 95 % of the seeds",
      {.rule = Rule::frequency,
       .measured = {"first {}, then {}; ratio in 95 % above {:.1f}", text(mean_of(early), "deg/s"),
                    text(mean_of(late), "deg/s"), quantile(ratios, 0.05)},
       .number = share_number("runs with more than three times the fluctuation at first",
                              count_above(ratios, 3), runs.size()),
       .seeds = runs.size()},
      happens_in(0.95, count_above(ratios, 3), runs.size()));
}

std::vector<double> largest_eigenvalues(const Run& run, const Span& span = {}) {
  const auto largest = [](const Instant& i) {
    return moduli(i.robots[0], section_5_2::gain(i.robots[0].mean))[0];
  };
  return over_ticks(run, largest, span);
}

double ticks_above(const Run& run, const Span& span) {
  const auto above = std::ranges::count_if(largest_eigenvalues(run, span), [](double x) { return x > 1; });
  return static_cast<double>(above);
}

Claim starts_on_path(const Runs& on, const Runs& away) {
  const std::vector<double> largest =
      each(on, [](const Run& run) { return std::ranges::max(largest_eigenvalues(run)); });
  const std::vector<double> early =
      each(away, [](const Run& run) { return ticks_above(run, {.until_s = arrived(run)}); });
  const std::vector<double> later =
      each(away, [](const Run& run) { return ticks_above(run, {.from_s = arrived(run)}); });
  const auto without = std::ranges::count_if(largest, [](double x) { return !(x > 1); }),
             with = std::ranges::count_if(early, [](double ticks) { return ticks > 0; }),
             late = std::ranges::count_if(later, [](double ticks) { return ticks > 0; });
  return assessed(
      "5.2-start-on-path", "below Figure 5.8",
      "A path that begins at the vehicle's first pose would suffice against the unstable transient: no "
      "eigenvalue above 1 at any tick, in 95 % of the seeds",
      {.rule = Rule::frequency,
       .measured = {"no eigenvalue above 1: {}, largest of all {:.4f}; from (-7, 0) facing away there is one "
                    "in {}, for {:.1f} s (mean), after arrival in {}",
                    share_text(without, on.size()), quantile(largest, 1), share_text(with, on.size()),
                    period_s * mean_of(early).value, share_text(late, on.size())},
       .number = share_number("runs from the path's start without an eigenvalue above 1", without, on.size()),
       .seeds = on.size()},
      happens_in(0.95, without, on.size()));
}

/// Two known landmarks, and noises eight times as large: 0.8 m and 8 degrees of each measurement, 0.8 m/s and
/// 0.8 rad/s of each command. Half of the second round of the path against the same half of the first.
Claim guaranteed(const ExperimentSettings& settings) {
  constexpr double round_s = two_rounds_s / 2;
  Setup rough = setup({-7, 0, pi}, two_rounds_s);
  rough.anchors = 2;
  rough.noise = 8;
  const Runs runs = runs_of(settings, "5.2, two anchors, noises times 8", rough);
  const auto rms_m = [&](const Span& span) {
    return each(runs, [&](const Run& run) { return rms_of(distances_m(run, circle, span)).value; });
  };
  const std::vector<double> early = rms_m({.from_s = round_s / 2, .until_s = round_s}),
                            late = rms_m({.from_s = 1.5 * round_s});
  const auto largest_m = [&](const Run& run) {
    return std::ranges::max(distances_m(run, circle, {.from_s = round_s / 2}));
  };
  const Interval growth = factor(late, early);
  return assessed("5.2-guaranteed", "Section 5.2, end of Example 5.2",
                  "In SLAM with full observability stability is guaranteed: with two known landmarks, even "
                  "with all noises times eight, the tracking error does not grow from the first round of the "
                  "circle to the second",
                  {.rule = Rule::boundedness,
                   .measured = {"rms distance from the reference over the second half of each round: first "
                                "{:.3f} m, second {:.3f} m, {}; farthest of all {:.2f} m",
                                rms_of(early).value, rms_of(late).value, text(in_percent(growth), "% more"),
                                quantile(each(runs, largest_m), 1)},
                   .number = ClaimNumber{"growth of the tracking error from the first round to the second",
                                         in_percent(growth), "%"},
                   .seeds = settings.seeds},
                  has_stopped_growing(growth));
}

Claim unaffected_control(const ExperimentSettings& settings, const Runs& away) {
  return affected_by_estimation(
      {"5.2-control",
       "Section 1.3",
       "Estimation errors do not undermine the performance of the controller: in a fully observable system it "
       "follows the circle in the last 50 s as closely by its estimate as by the truth, within a factor from "
       "0.8 to 1.25",
       {.from_s = steady_s}},
      facing_away, control_runs(settings, "5.2", facing_away), away);
}

LedgerEntry run_example_5_2(const ExperimentSettings& settings) {
  const Runs away = runs_of(settings, "5.2, facing away", facing_away),
             on = runs_of(settings, "5.2, from the path's start", on_path);
  const Run& first = away.front();
  return entry_of(
      example_5_2, settings,
      {section_5_2::equation_claims(), section_5_2::convergence_claims(), converges(away), steady_state(away),
       saturated(away), turn_rate(away), section_5_2::heading_claims(), starts_on_path(on, away),
       guaranteed(settings), section_5_2::range_claims(), unaffected_control(settings, away),
       consistent_enough("5.2-consistent", "Figure 5.7", away)},
      {map_figure("fig-5.6", "Feedback linearization and SLAM", facing_away, first),
       state_figure("fig-5.7", "State estimation and control by feedback linearization", first),
       eigenvalue_figure("fig-5.8", "Feedback linearization: eigenvalues of F - G L", first,
                         section_5_2::gain)});
}

}  // namespace

const Experiment example_5_2{"5.2",
                             "Feedback linearization around a circle while mapping",
                             {"fig-5.6", "fig-5.7", "fig-5.8"},
                             run_example_5_2};

}  // namespace incognita
