// What the regulator of Example 5.1 is given: the estimate, the truth, or nothing but where the vehicle ought
// to be (open loop).
//
// Experiment: the runs of Example 5.1, and the same with two known landmarks, as full observability takes;
// steered by the estimate, by the truth, and by the inputs that lead to the goal without noise. The same
// seeds have the same noises. Distances are root mean squares from 40 s to 50 s, when the vehicle stands at
// the goal.
#include "experiments/common.hpp"
#include "experiments/example_5_1.hpp"
#include "experiments/paired_factor.hpp"
#include "experiments/unaffected_control.hpp"

namespace incognita::section_5_1 {
namespace {

using closed_loop::Run, closed_loop::Runs;

constexpr closed_loop::Span at_goal{.from_s = 40};

double distance_m(const Run& run) { return closed_loop::rms_distance_m(run, to_goal, at_goal); }
double estimated_distance_m(const Run& run) {
  return closed_loop::rms_estimated_distance_m(run, to_goal, at_goal);
}

Claim open_loop(const Runs& closed, const Runs& open) {
  const Interval farther = factor(each(open, distance_m), each(closed, distance_m));
  return assessed(
      "5.1-open-loop", "Chapter 5, introduction",
      "Feedback control is more robust to uncertainty and disturbances than open loop: by the inputs that "
      "lead to the goal without noise the vehicle of Example 5.1 ends farther from it",
      {.rule = Rule::superiority,
       .measured = {"from (10, 10): by the inputs planned {}, by feedback of the estimate {}",
                    closed_loop::spread_text(each(open, distance_m), "m"),
                    closed_loop::spread_text(each(closed, distance_m), "m")},
       .number = ClaimNumber{"distance from the goal in open loop over that with feedback", farther},
       .seeds = open.size()},
      is_above(farther, 1));
}

std::ptrdiff_t near(const std::vector<double>& distances_m) {
  return std::ranges::count_if(distances_m, [](double d) { return d < closed_loop::near_m; });
}

/// The same rule as of Example 5.4.
Claim must_be_observable(const Runs& free, const Runs& known) {
  const std::vector<double> free_m = each(free, distance_m), known_m = each(known, distance_m),
                            estimated_m = each(free, estimated_distance_m);
  const Interval farther = factor(free_m, known_m);
  const auto in_words = [](const std::vector<double>& all) {
    return closed_loop::share_text(near(all), all.size()) + ", " + closed_loop::spread_text(all, "m");
  };
  return assessed(
      "5.1-must-be-observable", "Section 5.3",
      "SLAM must be fully observable for its estimates to be the input of a controller: without known "
      "landmarks the vehicle does not stand within 0.5 m of the goal in 95 % of the runs",
      {.rule = Rule::frequency,
       .measured = {"without: {}; by its own estimate {}. With two known landmarks: {}; without {} as far",
                    in_words(free_m), in_words(estimated_m), in_words(known_m), text(farther, "times")},
       .number =
           closed_loop::share_number("runs at the goal without known landmarks", near(free_m), free_m.size()),
       .why =
           "the vehicle gets there. What cannot be observed is the frame, which the start fixed: in it the "
           "vehicle stands at the goal, and what known landmarks take off is the error of the frame",
       .seeds = free.size()},
      !happens_in(0.95, near(free_m), free.size()),
      in_truth(happens_in(0.95, near(estimated_m), free.size()) && is_above(farther, 1)));
}

}  // namespace

std::vector<Claim> control_claims(const ExperimentSettings& settings, const Runs& free) {
  const closed_loop::Setup example = example_setup();
  const closed_loop::ControlRuns runs = closed_loop::control_runs(settings, "5.1", example);
  closed_loop::Setup planned = example;
  planned.steered_by = closed_loop::SteeredBy::plan;
  const Runs open = closed_loop::runs_of(settings, "5.1, open loop", planned);
  return {closed_loop::affected_by_estimation(
              {"5.1-control", "Abstract; Section 5.3",
               "Control is not affected by the estimation: in a fully observable system the regulator brings "
               "the vehicle as near to the goal by its estimate as by the truth (from 40 to 50 s, within a "
               "factor from 0.8 to 1.25)",
               at_goal},
              example, runs, free),
          open_loop(free, open), must_be_observable(free, runs.known)};
}

}  // namespace incognita::section_5_1
