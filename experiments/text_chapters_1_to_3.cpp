// Claims in the abstract and the running text of Chapters 1 to 3 about the linear case, and some that the
// planar vehicle shows at once: the parts are text_abstract.cpp, text_chapter_2.cpp, text_chapter_3.cpp and
// text_chapter_3_landmarks.cpp, each with its experiment at its head.
#include <array>

#include "experiments/common.hpp"
#include "experiments/linear_filter.hpp"
#include "experiments/text_claims.hpp"

namespace incognita {
namespace {

/// What a landmark's variance settles at: over the number of landmarks, for three noises of motion, and over
/// the robot's first variance. Lines: closed form; circles: 1000 steps of the filter, as its covariance of
/// robot and landmark, which is there sooner than the variance.
Plot riccati_limits() {
  const auto filter = [](double v, int n, double robot) {
    return after({.landmarks = n, .sigma_v_m = v, .robot_var_m2 = robot, .landmark_var_m2 = {}}, 1000)(0, 1);
  };
  const auto closed_form = [](double v, int n, double robot) {
    return monobot::settled_prior(
        {.landmarks = n, .sigma_v_m = v, .robot_var_m2 = robot, .landmark_var_m2 = {}})(0, 1);
  };
  Panel over_number{"robot known at first", "landmarks", "landmark's variance, m^2", {}},
      over_start{"s_v = 0.1 m", "robot's first variance, m^2", "landmark's variance, m^2", {}};
  const std::vector<int> numbers{1, 2, 3, 4, 5, 6, 7, 8, 9, 10};
  std::vector<double> starts;
  for (int i = 0; i <= 5; ++i) starts.push_back(0.01 * i);
  const Color colors[] = {Color::blue, Color::orange, Color::green};
  for (int i = 0; i < 3; ++i) {
    const auto add = [&](Panel& panel, const std::string& label, const auto& x, const auto& line,
                         const auto& circles) {
      panel.curves.push_back(curve_of(label, Style::line, colors[i], x, std::identity{}, line));
      panel.curves.push_back(curve_of("", Style::circles, colors[i], x, std::identity{}, circles));
    };
    const double v = std::array{0.05, 0.1, 0.3}[i];
    add(
        over_number, fmt::format("s_v = {} m", v), numbers, [&](int n) { return closed_form(v, n, 0); },
        [&](int n) { return filter(v, n, 0); });
    const int n = std::array{1, 2, 10}[i];
    add(
        over_start, fmt::format("{} landmark{}", n, n > 1 ? "s" : ""), starts,
        [&](double robot) { return closed_form(0.1, n, robot); },
        [&](double robot) { return filter(0.1, n, robot); });
  }
  return {"fig-riccati",
          "Where a landmark's variance settles without an anchor (s_w = 0.2 m)",
          2,
          {over_number, over_start}};
}

LedgerEntry run_text_chapters_1_to_3(const ExperimentSettings& settings) {
  return entry_of(text_chapters_1_to_3, settings,
                  {abstract_claims(settings.seeds), chapter_2_claims(settings.seeds),
                   chapter_3_stability_claims(), chapter_3_landmark_claims(settings.seeds)},
                  {riccati_limits()});
}

}  // namespace

const Experiment text_chapters_1_to_3{
    "text-1-3", "Claims in the text of Chapters 1 to 3", {"fig-riccati"}, run_text_chapters_1_to_3};

}  // namespace incognita
