#include "experiments/exploring_strategies.hpp"

#include <fmt/format.h>

#include <cmath>

#include "experiments/evidence.hpp"

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
Claim lower_at_the_14th(const Told& told, const std::vector<Runs>& runs) {
  std::string shown;
  for (std::size_t s = 0; s < 3; ++s)
    shown += fmt::format("{} {:.0f} nats at {:.1f} s{}", by_gaze()[s].name,
                         median_of_known(each(runs[s], at_the_14th)),
                         median_of_known(each(runs[s], time_of_the_14th)), s < 2 ? "; " : "");
  const auto fisher = each(runs[2], at_the_14th);
  const Interval to_i = bootstrap_mean(less(fisher, each(runs[0], at_the_14th)), judged_at),
                 to_ii = bootstrap_mean(less(fisher, each(runs[1], at_the_14th)), judged_at);
  Claim claim{told.id + "-14th-entropy",
              told.place + ", Figure 6.4",
              "With the same number of landmarks gaze by (6.8) has the lower entropy: at the 14th landmark "
              "below those of a constant rate and of mutual information",
              "-530, -550 and -610 at 19, 18 and 30 s",
              fmt::format("medians: {}. (iii) less (i): {} nats, less (ii): {} (99.9 %)", shown, text(to_i),
                          text(to_ii)),
              Verdict::does_not_hold,
              told.why,
              static_cast<int>(runs[0].size())};
  return judged(claim, to_i.high < 0 && to_ii.high < 0);
}

Claim fewer_landmarks(const Told& told, const std::vector<Runs>& runs) {
  const auto fisher = each(runs[2], located);
  const Interval fewer_i = bootstrap_mean(less(fisher, each(runs[0], located)), judged_at),
                 fewer_ii = bootstrap_mean(less(fisher, each(runs[1], located)), judged_at);
  Claim claim{told.id + "-fewer-landmarks",
              told.place,
              "A constant rate and mutual information insert landmarks faster than (6.8), which looks at "
              "those it has: fewer located after 35 s than with either",
              "at a faster pace",
              fmt::format("(iii) less (i): {}, less (ii): {} (99.9 %)", text(fewer_i), text(fewer_ii)),
              Verdict::does_not_hold,
              fewer_i.high < 0
                  ? "fewer than with a constant rate; than with mutual information so many rooms do not show"
                  : "no difference that so many rooms show",
              static_cast<int>(runs[0].size())};
  return judged(claim, fewer_i.high < 0 && fewer_ii.high < 0, fewer_i.high < 0);
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

std::vector<Claim> against_baselines(const Told& told, const std::string& what, const Runs& active,
                                     const std::vector<Runs>& runs) {
  const std::string leaves = what + " leaves less entropy than ";
  return {beats(told.id + "-random", told.place, leaves + "moving at random, the gaze turning alike",
                "moving at random", active, runs[0], told.why),
          beats(told.id + "-fixed", told.place,
                leaves + "a fixed path, three moves each ahead, left, back and right by a heading that turns",
                "the fixed path", active, runs[1], told.why),
          beats(told.id + "-standing", told.place, leaves + "standing and looking around", "standing", active,
                runs[2], told.why)};
}

std::vector<Claim> gaze_claims(const Told& told, const std::vector<Runs>& runs) {
  return {lower_at_the_14th(told, runs), fewer_landmarks(told, runs)};
}

Claim moves_across(const Told& told, const Runs& runs, const std::string& whose) {
  const std::vector<double> shares = each(runs, share_across);
  const Interval more = bootstrap_mean(less(shares, std::vector<double>(shares.size(), 2.0 / 3)), judged_at);
  Claim claim{told.id + "-across",
              told.place,
              "The moves that teach most are across the line of sight: up, down, left and right "
              "more often than their two thirds of all moves",
              "repeated up-down movements, as well as left-right",
              fmt::format("share of a run's moves less two thirds: {} (99.9 %), {}", text(more), whose),
              Verdict::does_not_hold,
              told.why,
              static_cast<int>(runs.size())};
  return judged(claim, more.low > 0);
}

std::string in_numbers(const std::vector<Strategy>& strategies, const std::vector<Runs>& runs) {
  std::string all;
  for (std::size_t s = 0; s < runs.size(); ++s)
    all += (s > 0 ? "; " : "") + in_numbers(strategies[s].name, runs[s]);
  return all;
}

}  // namespace incognita::exploring
