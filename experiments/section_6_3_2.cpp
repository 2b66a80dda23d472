// Section 6.3.2: a person holds the camera and moves it as the screen says, and what becomes of it where the
// screen is obeyed late or wrongly.
//
// Experiment: scenarios/free-camera.toml in the hand of a simulated person (control/person.hpp): nobody tells
// the filter what the hand does, so that it believes in accelerations of 1.5 m/s^2; what is to be learnt is
// position and map, as there; the gaze turns steadily. The plan of the comparison, written before the runs:
// persons paired by seed, who go 0.2 too far or not far enough (1 sigma) of what is shown; judged by the
// entropy of camera, map and what is not mapped yet together at the end.
#include <fmt/format.h>

#include <cmath>

#include "experiments/evidence.hpp"
#include "experiments/exploring_comparison.hpp"
#include "experiments/list.hpp"

namespace incognita {
namespace {

using namespace exploring;

Strategy person(const std::string& name, const Sets& sets) {
  Strategy s{name,
             {"person.holds=true", "filter.sigma_acceleration_m_s2=1.5", "decision.metric=position-and-map",
              "decision.gaze=constant-rate"}};
  s.sets.insert(s.sets.end(), sets.begin(), sets.end());
  return s;
}

const std::vector<Strategy>& persons() {
  static const std::vector<Strategy> all{
      person("at once", {"person.delay_s=0"}), person("a second late", {"person.delay_s=1"}),
      person("wrong half of the time", {"person.delay_s=0", "person.wrong=0.5"}),
      person("always wrong", {"person.delay_s=0", "person.wrong=1"}),
      person("shown ways at random", {"person.delay_s=0", "decision.strategy=random"})};
  return all;
}

/// The ways that were shown, by their number in the order of the thesis: Figure 6.7 (b).
Panel shown_ways(const Run& run) {
  const std::vector<std::string> names{"go_forward", "go_backwards", "go_right", "go_left",
                                       "go_up",      "go_down",      "stay"};
  Panel p{"1 forward, 2 back, 3 right, 4 left, 5 up, 6 down, 7 stay", "t, s", "shown", {}};
  Curve ways{"way", Style::points, {}, {}, {}, Colour::blue};
  for (const exploring::Decision& d : run.decisions)
    for (std::size_t a = 0; a < names.size(); ++a)
      if (d.action == names[a]) ways.x.push_back(d.t_s), ways.y.push_back(static_cast<double>(a + 1));
  p.curves = {ways};
  return p;
}

Claim across(const Runs& runs) {
  const Across across = across_the_line_of_sight(runs);
  return judged({.id = "6.3.2-across",
                 .place = "Section 6.3.2, Figure 6.7",
                 .statement = "To a person, too, it shows ways across the line of sight, up, down, left and "
                              "right, more often than their two thirds of all",
                 .printed = "repeated up-down movements, as well as left-right commands",
                 .measured = fmt::format("{:.0f} % of {:.0f} ways", 100 * across.share, across.moves),
                 .why = "position and map are learnt as well by going ahead and back",
                 .runs = static_cast<int>(runs.size())},
                across.beyond_chance());
}

LedgerEntry run(const ExperimentSettings& all_seeds) {
  ExperimentSettings settings = all_seeds;
  settings.seeds = (all_seeds.seeds + 3) / 4;
  LedgerEntry entry{section_6_3_2.id, section_6_3_2.title, "", {}, {}};
  std::vector<Runs> runs;
  for (const Strategy& s : persons()) runs.push_back(runs_of("free-camera", s, settings));
  const char* place = "Section 6.3.2";
  const std::string none = "no difference that so many rooms show";
  Claim random =
      beats("6.3.2-random", place,
            "What the screen shows helps a person: less entropy is left than by ways shown at random",
            "ways at random", runs[0], runs[4], none);
  random.measured += ". ";
  for (std::size_t s = 0; s < runs.size(); ++s)
    random.measured += in_numbers(persons()[s].name, runs[s]) + (s + 1 < runs.size() ? "; " : "");
  entry.claims = {
      random,
      beats("6.3.2-late", place, "Who obeys at once leaves less entropy than who is a second late",
            "a second late", runs[0], runs[1], none),
      beats("6.3.2-wrong", place, "Who obeys leaves less entropy than who goes another way half of the time",
            "wrong half of the time", runs[0], runs[2], none),
      beats("6.3.2-always-wrong", place, "and than who always goes another way", "always wrong", runs[0],
            runs[3], none),
      across(runs[0])};
  const Plot plot{"fig-6.7",
                  "A camera in a hand: entropies, and the ways that were shown",
                  1,
                  {entropies("", runs[0].front()), shown_ways(runs[0].front())}};
  entry.figures = {draw_plot(settings.out, plot, nullptr)};
  return entry;
}

}  // namespace

const Experiment section_6_3_2{"6.3.2", "A person who holds the camera", {"fig-6.7"}, run};

}  // namespace incognita
