// Section 6.3: a camera that moves freely explores a room of points, and what becomes of it by other ways to
// choose.
//
// Experiment: scenarios/free-camera.toml (room of 6 x 6 x 2.5 m, 33 points, 6 of them known; 0.3 m a second;
// 35 s). The plan of the comparison, written before the runs: strategies in the same rooms with the same
// noises (paired by seed); what counts is the entropy of camera, map and what is not mapped yet together
// (Figure 6.3: always 27 landmarks), at the end; beside it the position's error, landmarks located (known to
// 0.3 of their distance), the share of the room that was looked at, and when the 14th was located.
// Differences are means with intervals by bootstrap over the seeds. A run that ends lost counts with what it
// last believed, which is more than it knows. Baselines turn as (i) does.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/evidence.hpp"
#include "experiments/exploring_comparison.hpp"
#include "experiments/list.hpp"

namespace incognita {
namespace {

using namespace exploring;

/// (i), (ii), (iii) of the thesis, in their order.
const std::vector<Strategy>& thesis_strategies() {
  static const std::vector<Strategy> all{{"(i) constant rate", {"decision.gaze=constant-rate"}},
                                         {"(ii) mutual information", {"decision.gaze=mutual-information"}},
                                         {"(iii) Fisher information", {"decision.gaze=fisher"}}};
  return all;
}

const char* const round_trip =
    "decision.sequence=go_forward go_forward go_forward go_left go_left go_left go_backwards go_backwards "
    "go_backwards go_right go_right go_right";

const std::vector<Strategy>& others() {
  static const std::vector<Strategy> all{
      {"at random", {"decision.strategy=random", "decision.gaze=constant-rate"}},
      {"fixed path", {"decision.strategy=fixed-path", round_trip, "decision.gaze=constant-rate"}},
      {"standing", {"decision.strategy=none", "decision.gaze=constant-rate"}},
      {"Fisher with R", {"decision.gaze=fisher-given-state"}},
      {"two ahead", {"decision.gaze=constant-rate", "decision.horizon=2", "decision.max_evaluations=140"}},
      {"three ahead", {"decision.gaze=constant-rate", "decision.horizon=3", "decision.max_evaluations=140"}},
      {"one a frame", {"decision.gaze=constant-rate", "decision.schedule=one-per-frame"}}};
  return all;
}

/// Entropy at the 14th located landmark; none where there were never 14.
double at_the_14th(const Run& run) { return run.entropy_when_located(14).value_or(std::nan("")); }

/// The printed order of the entropies at the 14th landmark: (iii) below (ii) below (i).
std::vector<Claim> at_equal_maps(const std::vector<Runs>& thesis) {
  std::vector<std::string> shown;
  for (std::size_t s = 0; s < 3; ++s)
    shown.push_back(fmt::format("{} {:.0f} nats at {:.1f} s", thesis_strategies()[s].name,
                                median_of_known(each(thesis[s], at_the_14th)),
                                median_of_known(each(thesis[s], [](const Run& r) {
                                  return r.located_at_s(14).value_or(std::nan(""));
                                }))));
  const Interval to_i = bootstrap_mean(less(each(thesis[2], at_the_14th), each(thesis[0], at_the_14th)),
                                       judged_at),
                 to_ii = bootstrap_mean(less(each(thesis[2], at_the_14th), each(thesis[1], at_the_14th)),
                                        judged_at);
  Claim lower{"6.3-14th-entropy",
              "Section 6.3.1, Figure 6.4",
              "With the same number of landmarks gaze by (6.8) has the lower entropy: at the 14th landmark "
              "below those of "
              "a constant rate and of mutual information",
              "-530, -550 and -610 at 19, 18 and 30 s",
              fmt::format("medians: {}; {}; {}. (iii) less (i): {} nats, less (ii): {} (99.9 %)", shown[0],
                          shown[1], shown[2], text(to_i), text(to_ii)),
              Verdict::does_not_hold,
              "here points are born where they come into view, all at once, so that the 14th comes within "
              "seconds and "
              "strategies had no time to differ",
              static_cast<int>(thesis[0].size())};
  const auto landmarks = [](const Run& r) { return static_cast<double>(r.located_t_s.size()); };
  const Interval fewer_i =
                     bootstrap_mean(less(each(thesis[2], landmarks), each(thesis[0], landmarks)), judged_at),
                 fewer_ii =
                     bootstrap_mean(less(each(thesis[2], landmarks), each(thesis[1], landmarks)), judged_at);
  Claim slower{"6.3-fewer-landmarks",
               "Section 6.3.1",
               "A constant rate and mutual information insert landmarks faster than (6.8), which looks at "
               "those it has: "
               "fewer located after 35 s than with either",
               "at a faster pace",
               fmt::format("(iii) less (i): {}, less (ii): {} (99.9 %)", text(fewer_i), text(fewer_ii)),
               Verdict::does_not_hold,
               "",
               static_cast<int>(thesis[0].size())};
  return {judged(lower, to_i.high < 0 && to_ii.high < 0),
          judged(slower, fewer_i.high < 0 && fewer_ii.high < 0, fewer_i.high < 0)};
}

Claim moves_across(const Runs& runs) {
  const Across across = across_the_line_of_sight(runs);
  Claim claim{"6.3-across",
              "Section 6.3.2",
              "The moves that teach most are across the line of sight: up, down, left and right "
              "more often than their two thirds of all moves",
              "repeated up-down movements, as well as left-right",
              fmt::format("{:.0f} % of {:.0f} moves, gaze by (6.8)", 100 * across.share, across.moves),
              Verdict::does_not_hold,
              "",
              static_cast<int>(runs.size())};
  return judged(claim, across.beyond_chance());
}

Claim explores(const Runs& ours, const Runs& blind) {
  const auto seen = [](const Run& r) { return r.coverage; };
  const Interval more = bootstrap_mean(less(each(ours, seen), each(blind, seen)), judged_at);
  Claim claim{"6.3-unseen-pay",
              "Section 6.2, Figure 6.3",
              "Landmarks that are expected where nobody has looked make exploring pay: with them more of the "
              "room is seen "
              "than without, gaze by mutual information",
              "the only thing that prevents our control strategies from defaulting to homeostasis",
              fmt::format("share of the room: {} more (99.9 %)", text(more)),
              Verdict::does_not_hold,
              "",
              static_cast<int>(ours.size())};
  return judged(claim, more.low > 0);
}

LedgerEntry run(const ExperimentSettings& all_seeds) {
  ExperimentSettings settings = all_seeds;
  settings.seeds = (all_seeds.seeds + 3) / 4;  // eleven strategies each
  LedgerEntry entry{section_6_3.id, section_6_3.title, "", {}, {}};
  std::vector<Runs> thesis, other;
  for (const Strategy& s : thesis_strategies()) thesis.push_back(runs_of("free-camera", s, settings));
  for (const Strategy& s : others()) other.push_back(runs_of("free-camera", s, settings));
  const Runs blind = runs_of(
      "free-camera",
      {"nothing expected", {"decision.gaze=mutual-information", "explore.expected_landmarks=1"}}, settings);
  const Runs &active = thesis[0], &fisher = thesis[2];
  std::string all;
  for (std::size_t s = 0; s < 3; ++s) all += in_numbers(thesis_strategies()[s].name, thesis[s]) + "; ";
  for (std::size_t s = 0; s < other.size(); ++s)
    all += in_numbers(others()[s].name, other[s]) + (s + 1 < other.size() ? "; " : "");
  Claim random =
      beats("6.3-random", "Section 6.2, 6.3.1",
            "Moving by mutual information leaves less entropy than moving at random, the gaze turning "
            "alike",
            "moving at random", active, other[0], "");
  random.measured += ". " + all;
  entry.claims = {
      random,
      beats("6.3-fixed", "Section 6.2, 6.3.1", "Likewise less than along a fixed path, a square of 0.9 m",
            "the fixed path", active, other[1], ""),
      beats("6.3-standing", "Section 6.2, 6.3.1", "Likewise less than standing and looking around",
            "standing", active, other[2], "")};
  const auto add = [&](const std::vector<Claim>& claims) {
    entry.claims.insert(entry.claims.end(), claims.begin(), claims.end());
  };
  add(at_equal_maps(thesis));
  entry.claims.push_back(
      beats("6.3-look-ahead-2", "Section 6.2, 6.3.1",
            "Looking two actions ahead, in the time that greedy scores take in all frames, "
            "leaves less entropy than the greedy choice",
            "one ahead", other[4], active, "no difference that so many rooms show"));
  entry.claims.push_back(beats("6.3-look-ahead-3", "Section 6.2, 6.3.1",
                               "Looking three actions ahead likewise", "one ahead", other[5], active,
                               "no difference that so many rooms show"));
  entry.claims.push_back(
      beats("6.3-every-frame", "Section 6.2, 6.3.1",
            "All actions in every frame leave less entropy than one in each, as the thesis could",
            "one action a frame", active, other[6], "no difference that so many rooms show"));
  entry.claims.push_back(moves_across(fisher));
  entry.claims.push_back(explores(thesis[1], blind));
  std::vector<std::string> names;
  for (const Strategy& strategy : thesis_strategies()) names.push_back(strategy.name);
  for (const Plot& plot :
       {map_figure("fig-6.4", "Exploring by mutual information, gaze by strategy", names, thesis),
        error_figure("fig-6.5", "Estimation errors and their 2 sigma bounds, gaze by strategy", names,
                     thesis)})
    entry.figures.push_back(draw_plot(settings.out, plot, nullptr));
  return entry;
}

}  // namespace

const Experiment section_6_3{"6.3", "A camera that explores a room of points", {"fig-6.4", "fig-6.5"}, run};

}  // namespace incognita
