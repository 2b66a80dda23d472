// Look-ahead over one or several actions.
#include "incognita/decision/look_ahead.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "incognita/decision/action_choice.hpp"
#include "incognita/math/random.hpp"

namespace incognita {
namespace {

/// A robot on a line that steps left, stays or steps right, with a wall at x = 30.
class Steps final : public ActionSet {
 public:
  int count() const override { return 3; }
  int stay() const override { return 1; }
  ActionOutcome after(const BlockVector& state, int action) const override {
    ActionOutcome out{state, BlockMatrix::Identity(1, 1), 0.01 * BlockMatrix::Identity(1, 1)};
    out.state[0] += action - 1;
    out.outside_m = std::max(0.0, out.state[0] - 30);
    return out;
  }
};

/// Near landmarks are measured more accurately: the noise of each depends on its distance.
class NearPoints final : public Expectation {
 public:
  struct Point {
    PredictedMeasurement::Of of;
    BlockId block;
    int unseen;
    double x;
  };
  std::vector<Point> points;
  void expect(const BlockVector& state, std::vector<PredictedMeasurement>& measurements) const override {
    measurements.clear();
    for (const Point& p : points) {
      const double away = std::abs(p.x - state[0]);
      if (away > 1.5) continue;
      PredictedMeasurement measurement;
      measurement.of = p.of;
      measurement.block = p.block;
      measurement.unseen = p.unseen;
      measurement.unseen_var_m2 = 4;
      measurement.Hv = -MeasurementJacobian::Identity(1, 1);
      measurement.Hl = MeasurementJacobian::Identity(1, 1);
      if (p.of == PredictedMeasurement::Of::anchor) measurement.Hl.resize(1, 0);
      measurement.R = (0.01 + 0.1 * away * away) * MeasurementMatrix::Identity(1, 1);
      measurements.push_back(measurement);
    }
  }
};

/// Some information to the right, and far to the left much information that is out of reach of one step.
struct Line {
  AnyBelief belief;
  BlockId robot;
  NearPoints points;
  BlockVector at = BlockVector::Zero(1);

  Line() {
    robot =
        belief.add_vehicle(Chart::line(1), Eigen::VectorXd::Zero(1), 0.04 * Eigen::MatrixXd::Identity(1, 1));
    const auto map = [&](double x, double sigma) {
      const BlockId id = belief.augment(Chart::line(1), Eigen::VectorXd::Constant(1, x), {},
                                        sigma * sigma * Eigen::MatrixXd::Identity(1, 1));
      points.points.push_back({PredictedMeasurement::Of::mapped, id, 0, x});
    };
    map(1.8, 0.15);
    for (int i = 0; i < 5; ++i)
      points.points.push_back({PredictedMeasurement::Of::unseen, 0, i, -3.0 - 0.1 * i});
    points.points.push_back({PredictedMeasurement::Of::anchor, 0, 0, 2.2});
  }
  std::vector<double> scores(int horizon, int evaluations = 1000) {
    LookAhead ahead({Metric::state, horizon, evaluations, 1});
    return ahead.scores(belief, robot, at, Steps(), points);
  }
};

/// Exhaustive search: each sequence evaluated independently, without tree or beam.
double best_of_all(const Line& line, int first, int horizon) {
  double best = -1;
  const int sequences = static_cast<int>(std::pow(3, horizon - 1));
  for (int code = 0; code < sequences; ++code) {
    InformationGain gain;
    gain.start(line.belief, line.robot);
    BlockVector at = line.at;
    bool allowed = true;
    for (int step = 0, rest = code; step < horizon; ++step) {
      const int action = step == 0 ? first : rest % 3;
      if (step > 0) rest /= 3;
      const ActionOutcome out = Steps().after(at, action);
      allowed = allowed && out.allowed();
      ImaginedStep imagined{out.A, out.N, {}};
      line.points.expect(out.state, imagined.measurements);
      gain.push(imagined);
      at = out.state;
    }
    if (allowed) best = std::max(best, gain.of_state());
  }
  return best;
}

TEST(LookAhead, EqualsExhaustiveSearchWithAFullBeam) {
  for (const int horizon : {1, 2, 3, 4}) {
    Line line;
    const std::vector<double> scores = line.scores(horizon);
    for (int a = 0; a < 3; ++a)
      EXPECT_NEAR(scores[static_cast<std::size_t>(a)], best_of_all(line, a, horizon), 1e-9)
          << horizon << " " << a;
  }
}

TEST(LookAhead, FindsInformationBeyondOneStep) {
  Line line;
  const std::vector<bool> all(3, true);
  EXPECT_EQ(best_of(line.scores(1), all, 1), 2) << "one step: to the right";
  EXPECT_EQ(best_of(line.scores(3), all, 1), 0) << "with what follows: to the left";
}

TEST(LookAhead, RespectsItsBudgetAndFollowsEveryFirstAction) {
  Line line;
  LookAhead all({Metric::state, 5, 1000000, 1}), few({Metric::state, 5, 40, 1});
  const std::vector<double> full = all.scores(line.belief, line.robot, line.at, Steps(), line.points);
  const std::vector<double> beam = few.scores(line.belief, line.robot, line.at, Steps(), line.points);
  EXPECT_EQ(all.evaluations(), 3 + 9 + 27 + 81 + 243);
  EXPECT_LE(few.evaluations(), 3 + 4 * 9);
  for (std::size_t a = 0; a < 3; ++a) {
    EXPECT_LE(beam[a], full[a] + 1e-12) << "with fewer sequences the result is not better";
    EXPECT_GT(beam[a], 0);
  }
}

TEST(LookAhead, NeverPassesThroughWalls) {
  Line line;
  line.at[0] = 30;
  LookAhead ahead({Metric::state, 2, 1000, 1});
  ahead.scores(line.belief, line.robot, line.at, Steps(), line.points);
  EXPECT_EQ(ahead.allowed(), (std::vector<bool>{true, true, false}));
}

TEST(LookAhead, RefusesInvalidSettings) {
  EXPECT_THROW(LookAhead({Metric::state, 0, 10, 3}), std::invalid_argument);
  EXPECT_THROW(LookAhead({Metric::state, 1, 0, 3}), std::invalid_argument);
  EXPECT_THROW(LookAhead({Metric::position_and_map, 2, 10, 3}), std::invalid_argument);
  EXPECT_THROW(LookAhead({Metric::fisher, 2, 10, 3}), std::invalid_argument);
}

TEST(BestOf, StaysWhereNothingIsGainedOrAllowed) {
  EXPECT_EQ(best_of({1, 1, 1}, {true, true, true}, 1), 1);
  EXPECT_EQ(best_of({2, 1, 2}, {true, true, true}, 1), 0);
  EXPECT_EQ(best_of({2, 1, 3}, {true, true, false}, 1), 0);
  EXPECT_EQ(best_of({2, 1, 3}, {false, false, false}, 1), 1);
  EXPECT_EQ(best_of({2, 5, 3}, {true, false, true}, 1), 2) << "staying may be forbidden too";
}

/// Ten seconds of decisions at 10 frames a second.
std::vector<int> choices(const DecisionSettings& settings, std::uint64_t seed,
                         bool* scored_one_each = nullptr, const Tick& first = {0, 0, 0}) {
  Line line;
  ActionChoice choice(settings, {"left", "stay", "right"}, seed);
  std::vector<int> chosen;
  std::vector<double> before;
  for (int k = 0; k < 100; ++k) {
    const Tick tick{first.frame + k, first.t + 0.1 * k, 0.1};
    const bool decided = choice.choose(line.belief, line.robot, line.at, Steps(), line.points, tick);
    if (decided) chosen.push_back(choice.chosen());
    if (scored_one_each && !before.empty()) {
      int changed = 0;
      for (std::size_t i = 0; i < 3; ++i) changed += before[i] != choice.scores()[i];
      *scored_one_each = *scored_one_each && changed <= 1;
    }
    before = choice.scores();
  }
  return chosen;
}

TEST(ActionChoice, DecidesOncePerPeriodByStrategy) {
  DecisionSettings s;
  EXPECT_EQ(choices(s, 1), std::vector<int>(10, 2));
  s.strategy = DecisionSettings::Strategy::none;
  EXPECT_EQ(choices(s, 1), std::vector<int>(10, 1));
  s.strategy = DecisionSettings::Strategy::fixed_path;
  s.sequence = "left left right";
  EXPECT_EQ(choices(s, 1), (std::vector<int>{0, 0, 2, 0, 0, 2, 0, 0, 2, 0}));
  s.strategy = DecisionSettings::Strategy::random;
  s.sequence = "";
  const std::vector<int> random = choices(s, 1);
  for (int a = 0; a < 3; ++a) EXPECT_GT(std::count(random.begin(), random.end(), a), 0);
  EXPECT_EQ(random, choices(s, 1)) << "the same seed";
  EXPECT_NE(random, choices(s, 2));
}

TEST(ActionChoice, OneActionPerFrameDecidesTheSameInAStaticScene) {
  DecisionSettings s;
  s.schedule = DecisionSettings::Schedule::one_per_frame;
  bool one_each = true;
  std::vector<int> chosen = choices(s, 1, &one_each);
  EXPECT_TRUE(one_each);
  EXPECT_EQ(chosen.front(), 1) << "after the first frame only one action has a score: stay";
  chosen.erase(chosen.begin());
  EXPECT_EQ(chosen, std::vector<int>(9, 2));
}

/// Times since 1970 have their own rounding.
TEST(ActionChoice, DecidesAtTheSameRateForAnyFirstTick) {
  DecisionSettings s;
  s.period_s = 0.3;
  EXPECT_EQ(choices(s, 1).size(), 34u);
  EXPECT_EQ(choices(s, 1, nullptr, {17, 1.3e9, 0}).size(), 34u);
  EXPECT_EQ(choices(s, 1, nullptr, {5, -1000.1, 0}).size(), 34u);
}

/// Two frames per period, three actions: the first decision with all scores is that of the second period.
TEST(ActionChoice, OneActionPerFrameWaitsUntilAllHaveAScore) {
  DecisionSettings s;
  s.schedule = DecisionSettings::Schedule::one_per_frame;
  s.period_s = 0.2;
  for (const std::uint64_t seed : {1, 2, 3, 4, 5}) {
    std::vector<int> chosen = choices(s, seed);
    ASSERT_GT(chosen.size(), 40u);
    EXPECT_EQ(chosen.front(), 1) << "stay";
    int waited = 0;
    while (chosen[waited] == 1) ++waited;
    EXPECT_LE(waited, 2);
    chosen.erase(chosen.begin(), chosen.begin() + waited);
    EXPECT_EQ(chosen, std::vector<int>(chosen.size(), 2)) << "of seed " << seed;
  }
}

TEST(ActionChoice, ScoresOnlyAtDecisionsIfScheduledSo) {
  DecisionSettings s;
  const std::vector<int> in_every_frame = choices(s, 1);
  s.schedule = DecisionSettings::Schedule::at_decisions;
  EXPECT_EQ(choices(s, 1), in_every_frame);
}

/// Three actions in 100 frames with 10 decisions. The strategy `none` uses no scores, so that a recording that is replayed does not
/// wait for them.
TEST(ActionChoice, ScoresInEveryFrameWhatMayBeChosen) {
  class Counted final : public Expectation {
   public:
    mutable int count = 0;
    void expect(const BlockVector&, std::vector<PredictedMeasurement>& measurements) const override {
      measurements.clear();
      ++count;
    }
  };
  using Strategy = DecisionSettings::Strategy;
  using Schedule = DecisionSettings::Schedule;
  const auto evaluations = [](Strategy strategy, Schedule schedule) {
    DecisionSettings s;
    s.strategy = strategy;
    s.schedule = schedule;
    Line line;
    Counted expectation;
    ActionChoice choice(s, {"left", "stay", "right"}, 1);
    for (int k = 0; k < 100; ++k)
      choice.choose(line.belief, line.robot, line.at, Steps(), expectation, {k, 0.1 * k, 0.1});
    return expectation.count;
  };
  EXPECT_EQ(evaluations(Strategy::mutual_information, Schedule::every_frame), 300);
  EXPECT_EQ(evaluations(Strategy::random, Schedule::every_frame), 300);
  EXPECT_EQ(evaluations(Strategy::none, Schedule::every_frame), 30);
  EXPECT_EQ(evaluations(Strategy::mutual_information, Schedule::at_decisions), 30);
  EXPECT_EQ(evaluations(Strategy::none, Schedule::one_per_frame), 100);
}

TEST(ActionChoice, RefusesInvalidSettings) {
  const std::vector<std::string> names{"left", "stay", "right"};
  DecisionSettings s;
  s.strategy = DecisionSettings::Strategy::fixed_path;
  EXPECT_THROW(ActionChoice(s, names, 1), std::invalid_argument);
  s.sequence = "left rihgt";
  try {
    ActionChoice(s, names, 1);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("nearest is `right`"), std::string::npos) << error.what();
  }
  s = {};
  s.schedule = DecisionSettings::Schedule::one_per_frame;
  s.horizon = 2;
  EXPECT_THROW(ActionChoice(s, names, 1), std::invalid_argument);
}

/// A vehicle that cannot stop: every sequence of two actions ends beyond the wall.
class DeadEnd final : public ActionSet {
 public:
  int count() const override { return 3; }
  int stay() const override { return 1; }
  ActionOutcome after(const BlockVector& state, int action) const override {
    ActionOutcome out{state, BlockMatrix::Identity(1, 1), 0.01 * BlockMatrix::Identity(1, 1)};
    out.state[0] += 1 + 0.2 * action;
    out.outside_m = std::max(0.0, out.state[0] - 1.5);
    return out;
  }
};

TEST(LookAhead, DeadEndsKeepTheGainUpToThere) {
  const Line line;
  LookAhead one({Metric::state, 1, 100, 1}), two({Metric::state, 2, 100, 1});
  const auto greedy = one.scores(line.belief, line.robot, line.at, DeadEnd{}, line.points);
  EXPECT_GT(*std::min_element(greedy.begin(), greedy.end()), 0);
  EXPECT_EQ(two.scores(line.belief, line.robot, line.at, DeadEnd{}, line.points), greedy);
}

TEST(LookAhead, NanIsNeverTheBest) {
  const double none = std::nan("");
  EXPECT_EQ(best_of({none, 1, 2}, {true, true, true}, 1), 2);
  EXPECT_EQ(best_of({3, none, 2}, {true, true, true}, 1), 0);
  EXPECT_EQ(best_of({none, none, none}, {true, true, true}, 1), 1) << "stay";
}

TEST(ActionChoice, EachVehicleOfATeamDrawsIndependently) {
  const Line line;
  DecisionSettings settings;
  settings.strategy = DecisionSettings::Strategy::random;
  const std::vector<std::string> names{"left", "stay", "right"};
  ActionChoice first(settings, names, 1, 1), again(settings, names, 1, 1), second(settings, names, 1, 1, 1);
  int same = 0, apart = 0;
  for (int k = 0; k < 20; ++k) {
    const Tick tick{k, static_cast<double>(k), 1};
    for (ActionChoice* c : {&first, &again, &second})
      c->choose(line.belief, line.robot, line.at, Steps{}, line.points, tick);
    same += first.chosen() == again.chosen();
    apart += first.chosen() != second.chosen();
  }
  EXPECT_EQ(same, 20);
  EXPECT_GT(apart, 5);
}

}  // namespace
}  // namespace incognita
