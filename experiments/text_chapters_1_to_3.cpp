// Claims in the running text of Chapters 1 to 3 about the linear case, and some that the planar vehicle
// shows at once: the parts are text_chapter_2.cpp and text_chapter_3.cpp, each with its experiment at its
// head.
#include <array>

#include "experiments/common.hpp"
#include "experiments/monobot.hpp"
#include "experiments/text_claims.hpp"

namespace incognita {
namespace {

/// What a landmark's variance settles at: over the number of landmarks, for three noises of motion, and over
/// the robot's first variance. Lines: closed form; circles: 1000 steps of the filter, as its covariance of
/// robot and landmark, which is there sooner than the variance.
Plot riccati_limits() {
  const auto filter = [](double v, int n, double robot) {
    const monobot::Setup setup{.landmarks = n, .sigma_v_m = v, .robot_var_m2 = robot, .landmark_var_m2 = {}};
    return filtered(monobot::system(setup), monobot::first_covariance(setup), 1000)(0, 1);
  };
  const auto closed_form = [](double v, int n, double robot) {
    return robot + monobot::relative_variance(v, 0.2, n) - v * v;
  };
  Panel over_number{"robot known at first", "landmarks", "landmark's variance, m^2", {}},
      over_start{"s_v = 0.1 m", "robot's first variance, m^2", "landmark's variance, m^2", {}};
  const Color colors[] = {Color::blue, Color::orange, Color::green};
  for (int i = 0; i < 3; ++i) {
    const double v = std::array{0.05, 0.1, 0.3}[i];
    Curve line{fmt::format("s_v = {} m", v), Style::line, {}, {}, {}, colors[i]},
        circles{"", Style::circles, {}, {}, {}, colors[i]};
    for (int n = 1; n <= 10; ++n) {
      line.x.push_back(n), line.y.push_back(closed_form(v, n, 0));
      circles.x.push_back(n), circles.y.push_back(filter(v, n, 0));
    }
    over_number.curves.insert(over_number.curves.end(), {line, circles});
    const int count = std::array{1, 2, 10}[i];
    Curve from{fmt::format("{} landmark{}", count, count > 1 ? "s" : ""), Style::line, {}, {}, {}, colors[i]},
        at{"", Style::circles, {}, {}, {}, colors[i]};
    for (int step = 0; step <= 5; ++step) {
      const double robot = 0.01 * step;
      from.x.push_back(robot), from.y.push_back(closed_form(0.1, count, robot));
      at.x.push_back(robot), at.y.push_back(filter(0.1, count, robot));
    }
    over_start.curves.insert(over_start.curves.end(), {from, at});
  }
  return {"fig-riccati",
          "Where a landmark's variance settles without an anchor (s_w = 0.2 m)",
          2,
          {over_number, over_start}};
}

LedgerEntry run(const ExperimentSettings& settings) {
  return entry_of(text_chapters_1_to_3, settings,
                  concatenated({chapter_2_claims(settings.seeds), chapter_3_stability_claims(),
                                chapter_3_landmark_claims(settings.seeds)}),
                  {riccati_limits()});
}

}  // namespace

const Experiment text_chapters_1_to_3{
    "text-1-3", "Claims in the text of Chapters 1 to 3", {"fig-riccati"}, run};

}  // namespace incognita
