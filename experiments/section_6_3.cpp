// Section 6.3.1: a camera that moves freely explores a room of points.
//
// Experiment: scenarios/free-camera.toml (room of 6 x 6 x 2.5 m, 33 points, 6 of them known; 0.3 m a second;
// 35 s). The plan of the comparison, written before the runs: strategies in the same rooms with the same
// noises (paired by seed); what counts at the end is the entropy of camera, map and what is not mapped yet
// together (Figure 6.3: always 27 landmarks), and the position error. Baselines turn as (i) does.
#include "experiments/common.hpp"
#include "experiments/exploring_claims.hpp"
#include "experiments/exploring_figures.hpp"

namespace incognita::exploring {
namespace {

/// Compared with (i), as the baselines are.
const std::vector<Strategy>& look_ahead() {
  static const std::vector<Strategy> all{
      {"looking two ahead",
       {"decision.gaze=constant-rate", "decision.horizon=2", "decision.max_evaluations=140"}},
      {"looking three ahead",
       {"decision.gaze=constant-rate", "decision.horizon=3", "decision.max_evaluations=140"}}};
  return all;
}

const Common points{"6.3", "Section 6.3.1", "in rooms of points"};

Claim explores(const Runs& ours, const Runs& blind) {
  const Interval more = more_than(blind, ours, &Run::coverage);
  return assessed(
      "6.3-unseen-pay", "Section 6.2, Figure 6.3",
      "The exploration prior makes exploring pay off: with landmarks expected in unobserved space more of "
      "the room is covered than without, gaze by mutual information",
      {.rule = Rule::superiority,
       .measured = {"share of the room: {} more", text(more)},
       .number = ClaimNumber{"covered share of the room, with less without", more},
       .seeds = ours.size()},
      is_above(more, 0));
}

/// Nats within which two strategies count as equally good: a tenth of what moving by information gains here.
constexpr double as_good = 6;

Claim greedy_is_as_good(const std::string& id, const Runs& greedy, const Runs& ahead) {
  const Interval gap = more_than(greedy, ahead, final_entropy);
  return assessed(
      id, "Sections 2.4 and 6.3.1",
      fmt::format("The greedy choice is as good as {}, in the time that greedy scores take in all frames: "
                  "the entropies at the end differ by less than {} nats",
                  ahead.name, as_good),
      {.rule = Rule::equality,
       .measured = {"entropy less that of the greedy choice: {}", text(gap, "nats")},
       .number = ClaimNumber{"entropy less that of the greedy choice", gap, "nats"},
       .seeds = greedy.size()},
      agrees(gap, 0, as_good));
}

LedgerEntry run_section_6_3(const ExperimentSettings& all_seeds) {
  const ExperimentSettings settings = half_of(all_seeds);
  const auto runs = [&](const std::vector<Strategy>& all) {
    return runs_of_all("free-camera", all, settings);
  };
  const std::vector<Runs> gaze = runs(by_gaze()), rivals = runs(baselines()), ahead = runs(look_ahead()),
                          blind = runs(
                              {{"nothing expected",
                                {"decision.gaze=mutual-information", "exploration.expected_landmarks=1"}}});
  const auto each_gaze = [&](std::size_t k, const char* id) {
    return against({points.id + id, points.place, points.world},
                   "Moving by mutual information, gaze " + gaze[k].name, gaze[k], rivals);
  };
  return entry_of(
      section_6_3, settings,
      {with_numbers(each_gaze(0, "-i"), in_numbers(gaze) + "; " + in_numbers(rivals)), each_gaze(1, "-ii"),
       each_gaze(2, "-iii"), gaze_claims(points, gaze), inside_its_bounds(points, "Figure 6.5", gaze[2]),
       explores(gaze[1], blind[0]), greedy_is_as_good("6.3-look-ahead-2", gaze[0], ahead[0]),
       greedy_is_as_good("6.3-look-ahead-3", gaze[0], ahead[1])},
      {map_figure("fig-6.4", "Exploring by mutual information, gaze by strategy", gaze),
       error_figure("fig-6.5", "Estimation errors and their 2 sigma bounds, gaze by strategy", gaze)});
}

}  // namespace
}  // namespace incognita::exploring

const incognita::Experiment incognita::section_6_3{"6.3",
                                                   "A camera that explores a room of points",
                                                   {"fig-6.4", "fig-6.5"},
                                                   exploring::run_section_6_3,
                                                   true};
