// Section 6.3.2: a hand-held camera, on images.
//
// Experiment: scenarios/hand-held.toml (commands of a second each, executed by an operator model, who also turns
// the camera; 15 images a second; 40 s) with the features of the thesis and its metric: of position and map,
// and of features in the actual map only, so that nothing is expected in unobserved space; fewer than 50
// landmarks. Operators of ours: one who obeys after 1 s in place of 0.3 s, and one who moves otherwise half of
// the time in place of one time in twenty.
#include "experiments/common.hpp"
#include "experiments/exploring_claims.hpp"
#include "experiments/exploring_figures.hpp"
#include "experiments/thesis_features.hpp"

namespace incognita::exploring {
namespace {

const Common by_hand{
    "6.3.2", "Section 6.3.2",
    "held in a hand, on images of rendered rooms (at most 50 features of Appendix C, begun as depth lines; "
    "start before a known sheet)"};

const std::vector<Strategy>& operators() {
  static const std::vector<Strategy> all{
      {"a prompt operator", {}},
      {"a late operator", {"operator.delay_s=1"}},
      {"an operator who is often wrong", {"operator.wrong_probability=0.5"}}};
  return all;
}

Claim worse_operator(const std::string& id, const std::string& statement, const Runs& prompt,
                     const Runs& worse) {
  const Interval factor = times(prompt, worse, &Run::position_rms_m);
  return assessed(id, by_hand.place, statement + ", " + by_hand.world,
                  {.rule = Rule::superiority,
                   .measured = {"position error over that of a prompt one: {}; {}; {}", text(factor),
                                in_numbers(worse), in_numbers(prompt)},
                   .number = ClaimNumber{"position error over that of a prompt operator", factor},
                   .seeds = worse.size()},
                  is_above(factor, 1));
}

LedgerEntry run_section_6_3_2(const ExperimentSettings& all_seeds) {
  const ExperimentSettings settings = half_of(all_seeds);
  Sets printed = as_printed_on_images("0.4");
  printed.insert(printed.end(), {"exploration.expected_landmarks=0", "map.max_landmarks=50"});
  const std::vector<Runs> runs = runs_of_all("hand-held", with(printed, operators()), settings, fresh_rooms);
  const Run& first = runs[0].front();
  return entry_of(
      section_6_3_2, settings,
      {with_numbers({moves_across(by_hand, runs[0])}, in_numbers(runs[0])),
       inside_its_bounds(by_hand, "Figure 6.5, by hand", runs[0]),
       worse_operator("6.3.2-late",
                      "An operator who obeys a second late, when the next command is already there, has the "
                      "larger position error",
                      runs[0], runs[1]),
       worse_operator("6.3.2-wrong",
                      "An operator who moves otherwise than commanded half of the time has the larger "
                      "position error",
                      runs[0], runs[2])},
      {{"fig-6.7",
        "A hand-held camera in the rendered room",
        1,
        {entropies("Entropies", first), choices("Commands to the operator", first)}}});
}

}  // namespace
}  // namespace incognita::exploring

const incognita::Experiment incognita::section_6_3_2{
    "6.3.2", "A camera in a hand, on images", {"fig-6.7"}, exploring::run_section_6_3_2, true};
