#include "experiments/exploring_strategies.hpp"

#include "experiments/common.hpp"

namespace incognita::exploring {
namespace {

const char* const round_trip =
    "decision.sequence=go_forward go_forward go_forward go_left go_left go_left go_backwards go_backwards "
    "go_backwards go_right go_right go_right";

const char* const to_and_fro = "decision.sequence=faster stay stay stay slower slower stay stay stay faster";

/// Entropy of camera, map and what is not mapped at the first decision with 14 located landmarks; none where
/// there were never 14. Its dimension is always the same: that of the map alone grows with what is mapped and
/// not located yet.
double at_the_14th(const Run& run) { return run.extended_when_located(14).value_or(std::nan("")); }
double time_of_the_14th(const Run& run) { return run.located_at_s(14).value_or(std::nan("")); }
double located(const Run& run) { return static_cast<double>(run.located_t_s.size()); }

/// The printed order of the entropies at the 14th landmark: (iii) below (ii) below (i).
Claim lower_at_the_14th(const Common& common, const std::vector<Runs>& runs) {
  std::string medians;
  for (std::size_t s = 0; s < 3; ++s)
    medians += fmt::format("{} {} nats at {} s{}", by_gaze()[s].name,
                           decimals(median_of_known(each(runs[s], at_the_14th)), 0),
                           decimals(median_of_known(each(runs[s], time_of_the_14th)), 1), s < 2 ? "; " : "");
  const Interval to_i = more_than(runs[0], runs[2], at_the_14th),
                 to_ii = more_than(runs[1], runs[2], at_the_14th);
  const auto pairs = [&](const Runs& other) {
    return less(each(runs[2], at_the_14th), each(other, at_the_14th)).size();
  };
  return assessed(
      common.id + "-14th-entropy", common.place + ", Figure 6.4",
      "With the same number of landmarks gaze by (6.8) has the lower entropy: at the 14th "
      "landmark below those of a constant rate and of mutual information" +
          common.variant,
      {.printed = "-530, -550 and -610 at 19, 18 and 30 s",
       .measured = {"medians: {}. (iii) less (i): {} nats, less (ii): {}", medians, text(to_i), text(to_ii)},
       .why = common.why,
       .seeds = std::min(pairs(runs[0]), pairs(runs[1]))},
      is_below(to_i, 0) && is_below(to_ii, 0));
}

Claim fewer_landmarks(const Common& common, const std::vector<Runs>& runs) {
  const Interval fewer_i = more_than(runs[0], runs[2], located),
                 fewer_ii = more_than(runs[1], runs[2], located);
  return assessed(common.id + "-fewer-landmarks", common.place,
                  "A constant rate and mutual information initialize landmarks faster than (6.8), which "
                  "measures those it has: fewer located after 35 s than with either" +
                      common.variant,
                  {.printed = "at a faster pace",
                   .measured = {"(iii) less (i): {}, less (ii): {}", text(fewer_i), text(fewer_ii)},
                   .why = "fewer than with a constant rate, but not than with mutual information",
                   .seeds = runs[0].size()},
                  is_below(fewer_i, 0) && is_below(fewer_ii, 0), is_below(fewer_i, 0));
}

/// What `active` is compared with.
struct Rival {
  std::string id, what, name;
  const Runs& runs;
};

std::vector<Claim> beats_each(const Common& common, const std::string& active_is, const Runs& active,
                              const std::vector<Rival>& rivals) {
  std::vector<Claim> claims;
  for (const Rival& rival : rivals)
    claims.push_back(beats(common.id + rival.id, common.place,
                           active_is + " leaves less entropy than " + rival.what + common.variant, rival.name,
                           active, rival.runs, common.why));
  return claims;
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
      {"at random", {"decision.strategy=random", "decision.gaze=constant-rate"}},
      {"fixed path", {"decision.strategy=fixed-path", round_trip, "decision.gaze=constant-rate"}},
      {"standing", {"decision.strategy=none", "decision.gaze=constant-rate"}}};
  return all;
}

const std::vector<Strategy>& driving() {
  static const std::vector<Strategy> all{{"mutual information", {}},
                                         {"at random", {"decision.strategy=random"}},
                                         {"to and fro", {"decision.strategy=fixed-path", to_and_fro}},
                                         {"standing", {"decision.strategy=none"}}};
  return all;
}

std::vector<Claim> against_baselines(const Common& common, const std::string& what, const Runs& active,
                                     const std::vector<Runs>& runs) {
  return beats_each(
      common, what, active,
      {{"-random", "moving at random, the gaze turning alike", "moving at random", runs[0]},
       {"-fixed", "a fixed path, three moves each ahead, left, back and right by a heading that turns",
        "the fixed path", runs[1]},
       {"-standing", "standing with a turning gaze", "standing", runs[2]}});
}

std::vector<Claim> driving_claims(const Common& common, const Runs& active, const std::vector<Runs>& runs) {
  return beats_each(
      common, "Driving by mutual information", active,
      {{"-random", "driving at random, by the accelerations of Table 6.1", "driving at random", runs[1]},
       {"-fixed", "driving to and fro", "driving to and fro", runs[2]},
       {"-standing", "standing", "standing", runs[3]}});
}

std::vector<Claim> gaze_claims(const Common& common, const std::vector<Runs>& runs) {
  return {lower_at_the_14th(common, runs), fewer_landmarks(common, runs)};
}

Claim moves_across(const Common& common, const Runs& runs, const std::string& whose) {
  const Interval more =
      bootstrap_mean(less(each(runs, share_across), std::vector<double>(runs.size(), 2.0 / 3)));
  return assessed(common.id + "-across", common.place,
                  "The most informative moves are across the line of sight: up, down, left and right more "
                  "often than their two thirds of all moves" +
                      common.variant,
                  {.printed = "repeated up-down movements, as well as left-right",
                   .measured = {"share of a run's moves less two thirds: {}, {}", text(more), whose},
                   .why = common.why,
                   .seeds = runs.size()},
                  is_above(more, 0));
}

std::vector<Claim> with_numbers(std::vector<Claim> claims, const std::string& numbers) {
  claims.front().measured += ". " + numbers;
  return claims;
}

std::string in_numbers(const std::vector<Strategy>& strategies, const std::vector<Runs>& runs) {
  std::string all;
  for (std::size_t s = 0; s < runs.size(); ++s)
    all += (s > 0 ? "; " : "") + in_numbers(strategies[s].name, runs[s]);
  return all;
}

}  // namespace incognita::exploring
