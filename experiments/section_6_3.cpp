// Section 6.3: a camera that moves freely explores a room of points, and what becomes of it by other ways to
// choose.
//
// Experiment: scenarios/free-camera.toml (room of 6 x 6 x 2.5 m, 33 points, 6 of them known; 0.3 m a second;
// 35 s). The plan of the comparison, written before the runs: strategies in the same rooms with the same
// noises (paired by seed); what counts is the entropy of camera, map and what is not mapped yet together
// (Figure 6.3: always 27 landmarks), at the end; beside it how many are lost and the position's error,
// landmarks located (known to 0.3 of their distance), the share of the room that was looked at, and when the
// 14th was located. Differences are means with intervals by bootstrap over the seeds. A run that ends lost
// counts with what it last believed, which is more than it knows. Baselines turn as (i) does.
// Added after runs: a difference must show, too, among the rooms in which neither run diverged.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/evidence.hpp"
#include "experiments/exploring_strategies.hpp"
#include "experiments/list.hpp"

namespace incognita {
namespace {

using namespace exploring;

/// Compared with (i), beside the baselines.
const std::vector<Strategy>& variants() {
  static const std::vector<Strategy> all{
      {"Fisher with R", {"decision.gaze=fisher-given-state"}},
      {"two ahead", {"decision.gaze=constant-rate", "decision.horizon=2", "decision.max_evaluations=140"}},
      {"three ahead", {"decision.gaze=constant-rate", "decision.horizon=3", "decision.max_evaluations=140"}},
      {"one a frame", {"decision.gaze=constant-rate", "decision.schedule=one-per-frame"}}};
  return all;
}

Claim explores(const Runs& ours, const Runs& blind) {
  const auto seen = [](const Run& r) { return r.coverage; };
  const Interval more = bootstrap_mean(less(each(ours, seen), each(blind, seen)), assessed_at);
  return assessed(
      {.id = "6.3-unseen-pay",
       .place = "Section 6.2, Figure 6.3",
       .statement =
           "The exploration prior makes exploring pay: with landmarks expected in unseen places more of "
           "the room is seen than without, gaze by mutual information",
       .printed = "the only thing that prevents our control strategies from defaulting to homeostasis",
       .measured = fmt::format("share of the room: {} more (99.9 %)", text(more)),
       .runs = static_cast<int>(ours.size()),
       .least_runs = enough_runs},
      is_above(more, 0));
}

std::vector<Runs> runs_of_all(const std::vector<Strategy>& strategies, const ExperimentSettings& settings) {
  std::vector<Runs> runs;
  for (const Strategy& s : strategies) runs.push_back(runs_of("free-camera", s, settings));
  return runs;
}

std::vector<Claim> beyond_the_thesis(const Runs& active, const std::vector<Runs>& variant) {
  const char* place = "Section 6.2, 6.3.1";
  return {beats("6.3-look-ahead-2", place,
                "Looking two actions ahead, in the time that greedy scores take in all frames, "
                "leaves less entropy than the greedy choice",
                "one ahead", variant[1], active, "it leaves more"),
          beats("6.3-look-ahead-3", place, "Looking three actions ahead likewise", "one ahead", variant[2],
                active, "it leaves more"),
          beats("6.3-every-frame", place,
                "All actions in every frame leave less entropy than one in each, as the thesis could",
                "one action a frame", active, variant[3], "they leave more")};
}

LedgerEntry run(const ExperimentSettings& all_seeds) {
  ExperimentSettings settings = all_seeds;
  settings.seeds = (all_seeds.seeds + 1) / 2;  // eleven strategies each
  LedgerEntry entry{section_6_3.id, section_6_3.title, "", {}, {}};
  const std::vector<Runs> gaze = runs_of_all(by_gaze(), settings), other = runs_of_all(baselines(), settings),
                          variant = runs_of_all(variants(), settings);
  const Runs blind =
      runs_of("free-camera",
              {"nothing expected", {"decision.gaze=mutual-information", "exploration.expected_landmarks=1"}},
              settings);
  const auto add = [&](const std::vector<Claim>& claims) {
    entry.claims.insert(entry.claims.end(), claims.begin(), claims.end());
  };
  add(against_baselines({"6.3", "Section 6.2, 6.3.1", "it leaves more", ""}, "Moving by mutual information",
                        gaze[0], other));
  entry.claims.front().measured += ". " + in_numbers(by_gaze(), gaze) + "; " +
                                   in_numbers(baselines(), other) + "; " + in_numbers(variants(), variant);
  add(gaze_claims({"6.3", "Section 6.3.1",
                   "here points are initialized as they come into view, all at once, so that the 14th comes "
                   "within seconds, before the strategies differ",
                   ""},
                  gaze));
  add(beyond_the_thesis(gaze[0], variant));
  entry.claims.push_back(
      moves_across({"6.3", "Section 6.3.2", "they are not", ""}, gaze[2], "gaze by (6.8)"));
  entry.claims.push_back(explores(gaze[1], blind));
  std::vector<std::string> names;
  for (const Strategy& strategy : by_gaze()) names.push_back(strategy.name);
  for (const Plot& plot :
       {map_figure("fig-6.4", "Exploring by mutual information, gaze by strategy", names, gaze),
        error_figure("fig-6.5", "Estimation errors and their 2 sigma bounds, gaze by strategy", names, gaze)})
    entry.figures.push_back(draw_plot(settings.out, plot, nullptr));
  return entry;
}

}  // namespace

const Experiment section_6_3{
    "6.3", "A camera that explores a room of points", {"fig-6.4", "fig-6.5"}, run, true};

}  // namespace incognita
