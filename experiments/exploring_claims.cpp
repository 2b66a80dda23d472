#include "experiments/exploring_claims.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "experiments/comparisons.hpp"

namespace incognita::exploring {
namespace {

const char* const round_trip =
    "decision.sequence=go_forward go_forward go_forward go_left go_left go_left go_backwards go_backwards "
    "go_backwards go_right go_right go_right";

const char* const to_and_fro = "decision.sequence=faster stay stay stay slower slower stay stay stay faster";

/// The claim that ours is less than each rival's: less than some, if it is not than the others.
Claim less_than_each(const std::string& id, const std::string& place, const std::string& statement,
                     const std::string& what, const std::vector<Comparison>& all, const Runs& ours) {
  std::string measured = what;
  for (const Comparison& one : all)
    measured += fmt::format("{} {}: {}", &one == &all.front() ? "" : ";", one.rival,
                            text(one.number.value, one.number.unit));
  return assessed(id, place, statement,
                  {.rule = Rule::superiority,
                   .measured = measured,
                   .number = deciding(all),
                   .why = condition("less than", all),
                   .seeds = ours.size()},
                  all_shown(all), any_shown(all) == Answer::shown ? on_condition(true) : in_truth(true));
}

Claim less_entropy(const Common& common, const std::string& who, const Runs& ours,
                   const std::vector<Runs>& rivals) {
  const std::string what = "entropy less that of";
  std::vector<Comparison> all;
  for (const Runs& rival : rivals)
    all.push_back(claimed_below(rival.name,
                                {what + " " + rival.name, more_than(rival, ours, final_entropy), "nats"}, 0));
  return less_than_each(
      common.id + "-entropy", common.place,
      who + " leaves less entropy than every other strategy that is compared, " + common.world, what, all,
      ours);
}

Claim smaller_errors(const Common& common, const std::string& who, const Runs& ours,
                     const std::vector<Runs>& rivals) {
  const std::string what = "position error over that of";
  std::vector<Comparison> all;
  for (const Runs& rival : rivals)
    all.push_back(
        claimed_below(rival.name, {what + " " + rival.name, times(rival, ours, &Run::position_rms_m)}, 1));
  return less_than_each(
      common.id + "-errors", common.place,
      who + " localizes better (rms position error of a run) than every other strategy that is compared, " +
          common.world,
      what, all, ours);
}

/// What `of` of the runs of (iii) is more than that of each other gaze, claimed to be on that side of zero. `what` begins
/// what the numbers are: `time of (iii) less that of`.
template <class Of>
std::vector<Comparison> third_less(const std::vector<Runs>& runs, const Of& of, const std::string& what,
                                   const std::string& unit,
                                   Comparison (*claimed)(std::string, ClaimNumber, double)) {
  std::vector<Comparison> all;
  for (const auto& [k, name] : {std::pair<std::size_t, std::string>{0, "(i)"}, {1, "(ii)"}})
    all.push_back(claimed(name, {what + " " + name, more_than(runs[k], runs[2], of), unit}, 0));
  return all;
}

/// `(iii) less (i): -3 s (-4 to -2), less (ii): ...`
std::string in_words(const std::vector<Comparison>& third) {
  std::string words = "(iii)";
  for (const Comparison& one : third)
    words += fmt::format("{} less {}: {}", &one == &third.front() ? "" : ",", one.rival,
                         text(one.number.value, one.number.unit));
  return words;
}

Claim more_accurate_gaze(const Common& common, const std::vector<Runs>& runs) {
  const auto over = [&](std::size_t k, const std::string& name) {
    return claimed_below(
        name, {"position error of (iii) over that of " + name, times(runs[k], runs[2], &Run::position_rms_m)},
        1);
  };
  const std::vector<Comparison> all{over(0, "(i)"), over(1, "(ii)")};
  return assessed(
      common.id + "-gaze-errors", common.place + ", Figure 6.5",
      "Gaze by (6.8) localizes better than a constant rate and than mutual information, " + common.world,
      {.rule = Rule::superiority,
       .measured = {"rms position error over that of (i): {}; of (ii): {}; diverged {}, {} and {}",
                    text(all[0].number.value), text(all[1].number.value), diverged_of(runs[0]),
                    diverged_of(runs[1]), diverged_of(runs[2])},
       .number = deciding(all),
       .seeds = runs[2].size()},
      all_shown(all));
}

Claim lower_at_the_14th(const Common& common, const std::vector<Runs>& runs) {
  const std::vector<Comparison> entropy = third_less(
      runs, entropy_at_the_14th, "entropy of (iii) at the 14th landmark less that of", "nats", claimed_below);
  const auto pairs = [&](const Runs& other) {
    return less(each(runs[2], entropy_at_the_14th), each(other, entropy_at_the_14th)).size();
  };
  return assessed(
      common.id + "-14th-entropy", common.place + ", Figure 6.4",
      "With the same number of landmarks gaze by (6.8) has the lower entropy: at the 14th landmark, of runs that "
      "locate so many, below those of a constant rate and of mutual information, " +
          common.world,
      {.rule = Rule::superiority,
       .printed = "-530, -550 and -610",
       .measured = in_words(entropy),
       .number = deciding(entropy),
       .seeds = std::min(pairs(runs[0]), pairs(runs[1]))},
      all_shown(entropy));
}

/// Mean times within a run (restricted means): all rooms count, whether 14 were located in them or not.
Claim later_14th(const Common& common, const std::vector<Runs>& runs) {
  const std::vector<Comparison> time =
      third_less(runs, time_until_the_14th, "time until the 14th of (iii) less that of", "s", claimed_above);
  std::vector<std::string> medians;
  std::vector<int> without;
  for (const Runs& one : runs) {
    medians.push_back(decimals(median_of(each(one, time_until_the_14th)), 1));
    without.push_back(runs_without_14(one));
  }
  return assessed(
      common.id + "-14th-time", common.place + ", Figure 6.4",
      "Gaze by (6.8) takes longer to locate 14 landmarks than a constant rate and than mutual information: a longer time "
      "within a run, in the mean, where a run that does not locate 14 counts with its end, " +
          common.world,
      {.rule = Rule::superiority,
       .printed = "19, 18 and 30 s",
       .measured = {"medians {} s; not located until the end in {} of {} rooms; {}", fmt::join(medians, ", "),
                    fmt::join(without, ", "), runs[2].size(), in_words(time)},
       .number = deciding(time),
       .seeds = runs[2].size()},
      all_shown(time));
}

Claim fewer_landmarks(const Common& common, const std::vector<Runs>& runs) {
  const std::vector<Comparison> count =
      third_less(runs, located, "located by (iii) less by", "", claimed_below);
  return assessed(
      common.id + "-pace", common.place,
      "A constant rate and mutual information insert landmarks faster than (6.8): at the end more are "
      "located than with (6.8), " +
          common.world,
      {.rule = Rule::superiority,
       .measured = in_words(count),
       .number = deciding(count),
       .seeds = runs[0].size()},
      all_shown(count));
}

Claim closes_loops_faster(const Common& common, const std::vector<Runs>& runs) {
  const std::vector<Comparison> count =
      third_less(runs, returns, "returns by (iii) less by", "", claimed_above);
  return assessed(
      common.id + "-loops-pace", common.place,
      fmt::format("Gaze by (6.8) closes loops at a faster pace: more landmarks come back after {} s or more "
                  "out of view than with a constant rate and with mutual information, {}",
                  away_s, common.world),
      {.rule = Rule::superiority,
       .measured = in_words(count),
       .number = deciding(count),
       .seeds = runs[0].size()},
      all_shown(count));
}

}  // namespace

const std::vector<Strategy>& by_gaze() {
  static const std::vector<Strategy> all{{"(i) constant rate", {"decision.gaze=constant-rate"}},
                                         {"(ii) mutual information", {"decision.gaze=mutual-information"}},
                                         {"(iii) Fisher information", {"decision.gaze=fisher"}}};
  return all;
}

const std::vector<Strategy>& baselines() {
  static const std::vector<Strategy> all{
      {"moving at random", {"decision.strategy=random", "decision.gaze=constant-rate"}},
      {"a fixed path", {"decision.strategy=fixed-path", round_trip, "decision.gaze=constant-rate"}},
      {"standing", {"decision.strategy=none", "decision.gaze=constant-rate"}}};
  return all;
}

const std::vector<Strategy>& driving() {
  static const std::vector<Strategy> all{{"mutual information", {}},
                                         {"driving at random", {"decision.strategy=random"}},
                                         {"driving to and fro", {"decision.strategy=fixed-path", to_and_fro}},
                                         {"standing", {"decision.strategy=none"}}};
  return all;
}

std::vector<Claim> against(const Common& common, const std::string& who, const Runs& ours,
                           const std::vector<Runs>& rivals) {
  return {less_entropy(common, who, ours, rivals), smaller_errors(common, who, ours, rivals)};
}

std::vector<Claim> gaze_claims(const Common& common, const std::vector<Runs>& runs) {
  return {more_accurate_gaze(common, runs), lower_at_the_14th(common, runs), later_14th(common, runs),
          fewer_landmarks(common, runs), closes_loops_faster(common, runs)};
}

Claim inside_its_bounds(const Common& common, const std::string& place, const Runs& runs) {
  const Interval inside = bootstrap_mean(each(runs, share_inside_2_sigma));
  return assessed(
      common.id + "-bounds", place,
      fmt::format("The errors of position are inside their 2 sigma bounds (90 % of them or more): {}, {}",
                  runs.name, common.world),
      {.rule = Rule::coverage,
       .measured = {"{}, axis by axis; median NEES of a run {}", text(inside),
                    decimals(median_known(each(runs, &Run::nees)).value, 2)},
       .number = ClaimNumber{"share inside 2 sigma", inside},
       .seeds = runs.size()},
      is_above(inside, 0.9));
}

Claim moves_across(const Common& common, const Runs& runs) {
  const Interval share = bootstrap_mean(less(each(runs, share_across), std::vector<double>(runs.size(), 0)));
  return assessed(
      common.id + "-across", common.place,
      "The most informative moves are across the line of sight: up, down, left and right are more than "
      "their two thirds of all moves, " +
          common.world,
      {.rule = Rule::superiority,
       .measured = {"share of a run's moves {}, {}", text(share), runs.name},
       .number = ClaimNumber{"share of moves across the line of sight", share},
       .seeds = runs.size()},
      is_above(share, 2.0 / 3));
}

Claim backs_away(const Common& common, const Runs& runs) {
  const Interval share =
      bootstrap_mean(less(each(runs, share_backwards), std::vector<double>(runs.size(), 0)));
  return assessed(common.id + "-backwards", common.place,
                  "The vehicle drives more than half of its path backward, " + common.world,
                  {.rule = Rule::superiority,
                   .measured = {"share of the path {}", text(share)},
                   .number = ClaimNumber{"share of the path that is driven backward", share},
                   .seeds = runs.size()},
                  is_above(share, 0.5));
}

Claim accelerates(const Common& common, const Runs& runs) {
  const auto share = [](const Run& run) {
    double straight = 0;
    for (const Decision& d : run.decisions) straight += d.action == "slower" || d.action == "faster";
    return straight / static_cast<double>(run.decisions.size());
  };
  const Interval mean = bootstrap_mean(each(runs, share));
  return assessed(
      common.id + "-accelerates", common.place,
      "The most frequent actions are positive and negative linear accelerations: more than their two in "
      "seven, " +
          common.world,
      {.rule = Rule::superiority,
       .measured = {"share of a run's decisions {}", text(mean)},
       .number = ClaimNumber{"share of faster and slower", mean},
       .seeds = runs.size()},
      is_above(mean, 2.0 / 7));
}

std::vector<Claim> with_numbers(std::vector<Claim> claims, const std::string& numbers) {
  claims.front().measured += ". " + numbers;
  return claims;
}

}  // namespace incognita::exploring
