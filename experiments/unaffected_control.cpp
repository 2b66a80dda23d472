#include "experiments/unaffected_control.hpp"

#include <fmt/format.h>

#include <cmath>

#include "experiments/paired_factor.hpp"

namespace incognita::closed_loop {

ControlRuns control_runs(const ExperimentSettings& settings, const std::string& example, const Setup& setup) {
  const auto with = [&](const std::string& what, int anchors, SteeredBy by) {
    Setup other = setup;
    other.anchors = anchors, other.steered_by = by;
    return runs_of(settings, example + ", " + what, other);
  };
  return {with("two anchors", 2, SteeredBy::estimate), with("two anchors, by the truth", 2, SteeredBy::truth),
          with("by the truth", 0, SteeredBy::truth)};
}

Claim affected_by_estimation(const ControlClaim& claim, const Setup& setup, const ControlRuns& runs,
                             const Runs& free) {
  const Path& path = setup.robots[0].steering.path;
  const auto distances = [&](const Runs& all) {
    return each(all, [&](const Run& run) { return rms_distance_m(run, path, claim.span); });
  };
  const auto estimated = [&](const Run& run) { return rms_estimated_distance_m(run, path, claim.span); };
  const auto error = [&](const Run& run) { return rms_error_m(run, claim.span); };
  const std::vector<double> by_estimate = distances(runs.known), by_truth = distances(runs.known_by_truth);
  const Interval affected = factor(by_estimate, by_truth),
                 unobservable = factor(distances(free), distances(runs.free_by_truth)),
                 as_it_sees = factor(each(runs.known, estimated), by_truth);
  return assessed(
      claim.id, claim.place, claim.statement,
      {.rule = Rule::equality,
       .measured = {"two known landmarks: by the estimate {:.4f} m, by the truth {:.4f} m rms, {}; the "
                    "estimate is off by {:.4f} m. By its own estimate the vehicle is {} as far as by the "
                    "truth. Without known landmarks {}",
                    rms_of(by_estimate).value, rms_of(by_truth).value, text(affected, "times"),
                    rms_of(each(runs.known, error)).value, text(as_it_sees, "times"),
                    text(unobservable, "times")},
       .number = ClaimNumber{"distance by the estimate over that by the truth", affected},
       .why = "by its own estimate the vehicle does as well as the truth would let it. In truth it is "
              "farther off: the error of the estimate comes on top",
       .seeds = by_estimate.size()},
      as_good(affected), in_truth(as_good(as_it_sees) && is_above(affected, 1)));
}

}  // namespace incognita::closed_loop
