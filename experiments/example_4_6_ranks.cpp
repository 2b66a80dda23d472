// Example 4.6, Figure 4.4: ranks of the information matrix.
#include "experiments/common.hpp"
#include "experiments/example_4_6.hpp"

namespace incognita::two_bearings {
namespace {

std::vector<Run> runs_in_all_settings() {
  std::vector<Run> all;
  const Noise usual;
  for (const double process : {0.0, 0.1, 1.0, 10.0})
    for (const double bearing : {0.1, 1.0, 10.0}) {
      Setup s;
      s.noise = {process * usual.sigma_speed_mps, process * usual.sigma_turn_radps,
                 bearing * usual.sigma_bearing_rad};
      all.emplace_back(s);
    }
  for (const double dt : {0.05, 0.5}) all.emplace_back(Setup{.dt_s = dt});
  RandomStream random(1, "features");
  for (int i = 0; i < 20; ++i) {
    Setup s;
    s.features.first = {random.uniform(10, 40), 0};
    const double distance = random.uniform(8, 40), direction = radians(random.uniform(30, 60));
    s.features.second = distance * Vector2d(std::cos(direction), std::sin(direction));
    all.emplace_back(s);
  }
  return all;
}

RankCourse ranks_of(const std::vector<Knowledge>& known, const std::vector<Instant>& drive) {
  RankCourse course;
  for (std::size_t k = 0; k < known.size(); ++k) course.at_end[phase_of(drive[k].t_s)] = known[k].rank.rank;
  for (std::size_t k = 0; k < known.size(); ++k) {
    const Rank& r = known[k].rank;
    const VectorXd relative = r.singular_values / r.singular_values[0];
    course.throughout =
        course.throughout && known[k].clear() && r.rank == course.at_end[phase_of(drive[k].t_s)];
    course.least_kept = std::min(course.least_kept, relative[r.rank - 1]);
    if (r.rank < relative.size()) course.most_left_out = std::max(course.most_left_out, relative[r.rank]);
  }
  return course;
}

}  // namespace

const std::vector<Run>& runs() {
  static const std::vector<Run> all = runs_in_all_settings();
  return all;
}

const Run& usual() {
  static const Run run{Setup{}};
  return run;
}

const std::vector<Run>& runs_by_method() {
  static const std::vector<Run> all = [] {
    std::vector<Run> copies = runs();
    for (Run& run : copies) run.known = stripped(run.setup);
    return copies;
  }();
  return all;
}

int phase_of(double t_s) {
  return t_s <= at_rest_until_s + a_bit_s ? 0 : t_s <= north_until_s + a_bit_s ? 1 : 2;
}

RankCourse ranks_of(const Run& run) { return ranks_of(run.known, run.drive); }

RankCourse ranks_of_all(const std::vector<Run>& all) {
  RankCourse together = ranks_of(all.front());
  for (const Run& run : all) {
    const RankCourse one = ranks_of(run);
    together.throughout = together.throughout && one.is(together.at_end);
    together.least_kept = std::min(together.least_kept, one.least_kept);
    together.most_left_out = std::max(together.most_left_out, one.most_left_out);
  }
  return together;
}

std::string text(const Ranks& ranks) { return fmt::format("{}", fmt::join(ranks, ", ")); }

std::string text(const RankCourse& course) {
  return text(course.at_end) + (course.throughout ? "" : " at the ends of phases, not throughout");
}

namespace {

/// At rest there is nothing about any state alone.
bool none_alone(const std::vector<Run>& all) {
  for (int i = 0; i < states; ++i)
    if (most(state(i), at_rest_until_s, all) > 0) return false;
  return true;
}

std::vector<Claim> ranks() {
  const auto with = [](Jacobians jacobians) { return ranks_of(Run({.jacobians = jacobians})); };
  const RankCourse all = ranks_of_all(), segments = ranks_of_all(runs_by_method()),
                   late = with(Jacobians::odometry_late), measured = with(Jacobians::measured_speed);
  const Ranks printed{2, 4, 5};
  return {
      tested(
          "4.6-rank", "Figure 4.4, Example 4.6",
          "Rank of the information matrix at rest, while moving north, while turning to the east, from the "
          "first measurement of each on",
          {.rule = Rule::dimension,
           .printed = text(printed),
           .measured = {"{} in {} settings (singular values of the root, of the largest: kept from {:.1e} "
                        "on, left out {}); of the matrix (4.8), each step a segment: {}. The filter with F "
                        "of the step before: {}; with F by encoder speeds 2 % off: {}",
                        text(all), runs().size(), all.least_kept, below(all.most_left_out), text(segments),
                        text(late), text(measured)},
           .number = exactly("rank at the end, of 7", all.at_end[2]),
           .why = "2, 3, 4: moving north adds one, and turning one. What is printed is the rank of (4.8), "
                  "which freezes H inside a segment; a filter has it, too, when its F is not that of its "
                  "motion. The thesis does not say which it used"},
          InTruth{all.is(printed), in_truth(all.is({2, 3, 4}) && late.is(printed) && measured.is(printed))},
          ByMethod{segments.is(printed)}),
      tested("4.6-stationary", "below Figure 4.4, Example 4.6",
             "At rest only two states are observable, combinations of the positions of vehicle and features "
             "and of the heading: rank 2, and nothing about any state alone",
             {.rule = Rule::dimension,
              .measured = {"rank {}, of (4.8) {}; some information about a state alone: {}", all.at_end[0],
                           segments.at_end[0], yes_no(!none_alone(runs()))},
              .number = exactly("rank at rest, of 7", all.at_end[0])},
             InTruth{all.throughout && all.at_end[0] == 2 && none_alone(runs())},
             ByMethod{segments.throughout && segments.at_end[0] == 2 && none_alone(runs_by_method())})};
}

/// Columns in units, at the end: everything moved north, moved east, turned about the origin.
MatrixXd rigid_motions(const Run& run) {
  const auto& [first, second] = run.setup.features;
  const auto& pose = run.drive.back().pose;
  MatrixXd all = MatrixXd::Zero(states, 3);
  for (const int i : {x, x1, x2}) all(i, 0) = 1, all(i + 1, 1) = 1;
  all.col(2) << Vector2d(-pose.y(), pose.x()) / unit_m, 1, Vector2d(-first.y(), first.x()) / unit_m,
      Vector2d(-second.y(), second.x()) / unit_m;
  return all;
}

/// Largest share of a column that is observable.
double not_among(const MatrixXd& columns, const MatrixXd& unobservable) {
  const MatrixXd rest = columns - unobservable * (unobservable.transpose() * columns);
  return (rest.colwise().norm().array() / columns.colwise().norm().array()).maxCoeff();
}

/// What is missing of the rank at the end, and the observable part of rigid motions.
struct Deficiency {
  int most = 0, least = states;
  double modes = 0, turn = 0;

  explicit Deficiency(const std::vector<Run>& all) {
    for (const Run& run : all) {
      const Knowledge& last = run.known.back();
      const MatrixXd rigid = rigid_motions(run);
      modes = std::max(modes, not_among(rigid.leftCols(2), last.unobservable));
      turn = std::max(turn, not_among(rigid.rightCols(1), last.unobservable));
      most = std::max(most, states - last.rank.rank), least = std::min(least, states - last.rank.rank);
    }
  }
  bool is(int missing) const { return most == missing && least == missing && modes <= same; }
  bool has_turn() const { return turn <= same; }

 private:
  static constexpr double same = 1e-9;
};

Claim deficiency() {
  const Deficiency of_filter(runs()), of_stripped(runs_by_method());
  return tested(
      "4.6-deficiency", "Figure 4.4, Example 4.6",
      "After 14 s a rank deficiency of two remains: the modes of (4.20), position of the whole to "
      "the north and to the east (to 1e-9)",
      {.rule = Rule::dimension,
       .measured = {"{} at the end in {} settings, of (4.8) {}. Observable part of the modes of "
                    "(4.20) {}, of a turn of everything about the origin {}, and by (4.8) {:.2g}",
                    of_filter.most, runs().size(), of_stripped.most, below(of_filter.modes),
                    below(of_filter.turn), of_stripped.turn},
       .number = exactly("rank deficiency at the end", of_filter.most),
       .why = "three remain: the modes of (4.20) and a turn of everything, which changes no bearing "
              "either"},
      InTruth{of_filter.is(2), in_truth(of_filter.is(3) && of_filter.has_turn())},
      ByMethod{of_stripped.is(2)});
}

/// How many measurements of all settings have another rank than the information matrix.
int differing(std::vector<Knowledge> (*of)(const Setup&)) {
  int measurements = 0;
  for (const Run& run : runs()) {
    const std::vector<Knowledge> other = of(run.setup);
    for (std::size_t k = 0; k < other.size(); ++k)
      measurements += !other[k].clear() || other[k].rank.rank != run.known[k].rank.rank ? 1 : 0;
  }
  return measurements;
}

}  // namespace

std::vector<Claim> rank_claims() { return concatenated({ranks(), deficiency()}); }

Claim link() {
  int measurements = 0;
  for (const Run& run : runs()) measurements += static_cast<int>(run.known.size());
  const int by_method = differing(stripped), along = differing(along_the_motion);
  return tested(
      "4.6-link", "Section 4.3, above Example 4.6",
      "The rank of the information matrix at any point is directly linked to that of the observability "
      "matrix of the system: it is the same after each measurement",
      {.rule = Rule::dimension,
       .measured = {"of {} measurements in {} settings it differs at {} from that of [H_0; H_1 F_0; H_2 F_1 "
                    "F_0; ...] along the motion, and at {} from that of (4.8), each step a segment",
                    measurements, runs().size(), along, by_method},
       .number = exactly("measurements at which it differs from the rank along the motion", along)},
      InTruth{along == 0}, ByMethod{by_method == 0, in_truth(by_method > 0)});
}

}  // namespace incognita::two_bearings
