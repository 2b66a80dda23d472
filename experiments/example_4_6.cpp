// Example 4.6: information about a planar vehicle and two features from their bearings.
//
// Experiment: example_4_6_filter.hpp, features 15 m ahead and 17 m to the north-east, a measurement every 0.1
// s. The thesis prints neither noises nor positions. So all is done again with process noise times 0, 0.1, 1
// and 10 and bearing noise times 0.1, 1 and 10, with steps of 0.05 and 0.5 s, and with 20 random pairs of
// features (10 to 40 m ahead; 8 to 40 m off, 30 to 60 degrees to the east). No chance beyond that: Jacobians
// at the truth need no measurements. Measured: ranks, and marginal information of states, of the modes of
// Figure 4.6 and of distances, after each measurement. Holds: a rank when all measurements of a phase have it
// in all settings, with at least a factor of 1000 (a million in the information) between the singular value
// that counts least and the next; information is zero when more than 1e-7 of a direction is outside the
// information's range (in doubt between 1e-8 and 1e-6), and there `from` a phase on when it is zero at all
// measurements before and at none after. In truth: of the information. By the method: of the matrix (4.8), each
// step a segment, by the same rules.
#include "experiments/example_4_6.hpp"

#include <array>

#include "experiments/common.hpp"

namespace incognita::two_bearings {

double most(const Direction& c, double until_s, const std::vector<Run>& all) {
  double value = 0;
  for (const Run& run : all) {
    const std::vector<double> known = information(run, c);
    for (std::size_t k = 0; k < known.size() && run.drive[k].t_s <= until_s + a_bit_s; ++k)
      value = std::max(value, known[k]);
  }
  return value;
}

namespace {

/// Since when there is information: zero at all measurements before, at none after, and none in doubt.
enum class Since { start, north, turning, never, unclear };

Since since(const Run& run, const Direction& c) {
  for (std::size_t k = 0; k < run.known.size(); ++k) {
    const double outside = run.known[k].outside(c(run, k));
    const bool in_doubt = outside > 0.1 * outside_tolerance && outside < 10 * outside_tolerance;
    if (in_doubt || !run.known[k].clear()) return Since::unclear;
  }
  const std::vector<double> known = information(run, c);
  const auto positive = [](double v) { return v > 0; };
  const auto first = std::ranges::find_if(known, positive);
  if (first == known.end()) return Since::never;
  if (!std::all_of(first, known.end(), positive)) return Since::unclear;
  const auto k = static_cast<std::size_t>(first - known.begin());
  if (k == 0) return Since::start;
  const int phase = phase_of(run.drive[k].t_s);
  if (phase == phase_of(run.drive[k - 1].t_s)) return Since::unclear;
  return phase == 1 ? Since::north : Since::turning;
}

/// The same in all settings, else unclear.
Since since(const Direction& c, const std::vector<Run>& all = runs()) {
  const Since first = since(all.front(), c);
  for (const Run& run : all)
    if (since(run, c) != first) return Since::unclear;
  return first;
}

/// Since when the method of the thesis has a direction outside of the null space.
Since since_by_method(const Direction& c) { return since(c, runs_by_method()); }

std::string in_words(Since since) {
  constexpr std::array texts{"from the start", "from 10 s", "from 14 s", "never",
                             "not the same in all settings"};
  return texts[static_cast<std::size_t>(since)];
}

/// Since when there is information about the position of one point relative to another, and their distance.
struct Relative {
  Direction x_mode, y_mode, distance;
  Since north, east, apart, north_by_method, east_by_method;
  /// By their first states.
  Relative(int from, int to)
      : x_mode(difference(from, to)),
        y_mode(difference(from + 1, to + 1)),
        distance(two_bearings::distance(from, to)),
        north(since(x_mode)),
        east(since(y_mode)),
        apart(since(distance)),
        north_by_method(since_by_method(x_mode)),
        east_by_method(since_by_method(y_mode)) {}
};

/// Least share of a direction, over all settings and measurements, that is unobservable.
double least_outside(const Direction& c) {
  double value = 1;
  for (const Run& run : runs())
    for (std::size_t k = 0; k < run.known.size(); ++k)
      value = std::min(value, run.known[k].outside(c(run, k)));
  return value;
}

double at(const Run& run, const Direction& c, double t_s) {
  const std::size_t k = run.measurement_at(t_s);
  return run.known[k].marginal(c(run, k));
}

/// Of the usual setup, at the ends of phases.
std::string course_text(const Direction& c) {
  return fmt::format("{:.2g}, {:.2g}, {:.2g} 1/m^2 at 10, 14, 20 s", at(usual(), c, 10), at(usual(), c, 14),
                     at(usual(), c, 20));
}

/// It keeps growing: more at the end than a second after it began.
bool grows(const Direction& c, double from_s) { return at(usual(), c, end_s) > at(usual(), c, from_s + 1); }

/// With the first heading known to 0.02 rad.
const Run& oriented() {
  static const Run run{Setup{.sigma_heading_rad = 0.02}};
  return run;
}

Claim orientation() {
  const Direction c = state(heading);
  const Since truly = since(c), by_method = since_by_method(c);
  const double share = least_outside(c);
  const std::vector<double> given = information(oriented(), c);
  const auto late = [&](double dt) {
    return at(Run({.dt_s = dt, .jacobians = Jacobians::odometry_late}), c, end_s);
  };
  const double spurious = late(0.1), with_half_the_step = late(0.05);
  return tested(
      "4.6-orientation", "Figure 4.5, Example 4.6",
      "The orientation becomes observable when the vehicle moves: its marginal information is zero until 10 s "
      "and then increases",
      {.rule = Rule::dimension,
       .measured =
           {"above zero: {}, at least {:.2f} of the heading is unobservable; by (4.8) {}. Known to "
            "0.02 rad at first: {:.0f} to {:.0f} 1/rad^2. Odometry of the step before: {:.2f} 1/rad^2 "
            "at the end, {:.2f} with half the step",
            in_words(truly), share, in_words(by_method), given.front(), given.back(), spurious,
            with_half_the_step},
       .number = exactly("least share of the heading that is unobservable", share),
       .why = "it remains zero: turning vehicle, path and features together changes neither bearings nor "
              "odometry, as in Example 4.5. Jacobians at different instants let it increase, by an amount "
              "that depends on the step"},
      InTruth{truly == Since::north && grows(c, at_rest_until_s),
              in_truth(truly == Since::never && given.back() < given.front() && spurious > 0 &&
                       with_half_the_step < 0.75 * spurious)},
      ByMethod{by_method == Since::north});
}

Claim global_modes() {
  const Direction north = sum({x, x1, x2}), east = sum({y, y1, y2});
  const Since of_north = since(north), of_east = since(east);
  return tested(
      "4.6-global-modes", "Figure 4.6 (a), Example 4.6",
      "Information of the modes x_r + sum x_f and y_r + sum y_f remains zero",
      {.rule = Rule::dimension,
       .measured = {"above zero: {}, {}; at least {:.2f} and {:.2f} of these directions is unobservable",
                    in_words(of_north), in_words(of_east), least_outside(north), least_outside(east)}},
      InTruth{of_north == Since::never && of_east == Since::never},
      ByMethod{since_by_method(north) == Since::never && since_by_method(east) == Since::never});
}

/// Largest information until the vehicle moves, of coordinates and distances between vehicle and features.
struct AtRest {
  double coordinates = 0, distances = 0;

  explicit AtRest(const std::vector<Run>& all) {
    for (const auto& [from, to] : {std::pair(x, x1), std::pair(x, x2), std::pair(x1, x2)}) {
      for (const int axis : {0, 1})
        coordinates = std::max(coordinates, most(difference(from + axis, to + axis), at_rest_until_s, all));
      distances = std::max(distances, most(distance(from, to), at_rest_until_s, all));
    }
  }
  bool nothing() const { return coordinates == 0 && distances == 0; }
};

Claim relative_at_rest() {
  const AtRest truly(runs()), by_method(runs_by_method());
  return tested(
      "4.6-relative-at-rest", "Figure 4.6 (b), (c), Example 4.6",
      "Before the vehicle moves there is no information about the position of features relative to "
      "the vehicle or to each other",
      {.rule = Rule::dimension,
       .measured = {"largest up to 10 s: {:.2g} 1/m^2 of coordinates, {:.2g} of distances; by (4.8) "
                    "some is observable: {}",
                    truly.coordinates, truly.distances, yes_no(!by_method.nothing())},
       .number = exactly("information about a relative coordinate up to 10 s", truly.coordinates, "1/m^2")},
      InTruth{truly.nothing()}, ByMethod{by_method.nothing()});
}

Claim relative_2() {
  const Relative to_2(x, x2);
  return tested(
      "4.6-relative-2", "below Figure 4.5, Example 4.6",
      "While the vehicle moves north the position of feature 2 relative to it is observable",
      {.rule = Rule::dimension,
       .measured = {"x_r - x_f2 {}, y_r - y_f2 {}; by (4.8) {}, {}. Distance to feature 2 {}: {}",
                    in_words(to_2.north), in_words(to_2.east), in_words(to_2.north_by_method),
                    in_words(to_2.east_by_method), in_words(to_2.apart), course_text(to_2.distance)},
       .number = exactly("information about its distance at 14 s", at(usual(), to_2.distance, north_until_s),
                         "1/m^2"),
       .why = "its distance is. In northern and eastern axes the relative position turns with the "
              "heading, which is not observable"},
      InTruth{
          to_2.north == Since::north && to_2.east == Since::north,
          in_truth(to_2.north == Since::never && to_2.east == Since::never && to_2.apart == Since::north)},
      ByMethod{to_2.north_by_method == Since::north && to_2.east_by_method == Since::north});
}

/// What 4 s to the north tell of the distance of feature 1, which is so many degrees off the path.
struct OffTheLine {
  double degrees_off, known;
  int rank;
  bool clear;

  explicit OffTheLine(double off) : degrees_off(off) {
    Setup s;
    s.features.first = 15 * Vector2d(std::cos(radians(off)), std::sin(radians(off)));
    const Run run(s);
    const Knowledge& last = run.known[run.measurement_at(north_until_s)];
    known = at(run, distance(x, x1), north_until_s), rank = last.rank.rank, clear = last.clear();
  }
};

Claim line_of_sight() {
  const double ahead = most(distance(x, x1), north_until_s);
  std::vector<double> offs, known;
  bool off_is_known = true;
  for (const double off : {0.01, 0.1, 1.0, 10.0}) {
    const OffTheLine one(off);
    offs.push_back(off), known.push_back(one.known);
    off_is_known = off_is_known && one.rank == 4 && one.clear && one.known > 0;
  }
  return tested(
      "4.6-line-of-sight", "below Figure 4.5, Example 4.6",
      "The relative north position of feature 1 is not observable while the vehicle moves along the line of "
      "sight to it: nothing about its distance until 14 s, and some when it is off the line",
      {.rule = Rule::dimension,
       .measured = {"largest up to 14 s: {:.2g} 1/m^2, rank {}. At 14 s with feature 1 off the line by "
                    "{}/{}/{}/{} degrees {:.2g}/{:.2g}/{:.2g}/{:.2g}, rank 4: {}; as angle^{:.2f}",
                    ahead, ranks_of_all().at_end[1], offs[0], offs[1], offs[2], offs[3], known[0], known[1],
                    known[2], known[3], yes_no(off_is_known), exponent_of(offs, known)},
       .number = exactly("information about the distance up to 14 s", ahead, "1/m^2")},
      InTruth{ahead == 0 && most(difference(x, x1), north_until_s) == 0 && off_is_known},
      ByMethod{most(difference(x, x1), north_until_s, runs_by_method()) == 0});
}

Claim relative_1() {
  const Relative to_1(x, x1);
  return tested(
      "4.6-relative-1", "Figure 4.6 (b), Example 4.6",
      "Only after the vehicle turns to the east does information about the position of feature 1 relative to "
      "it, x_r - x_f1 and y_r - y_f1, start to increase",
      {.rule = Rule::dimension,
       .measured = {"x_r - x_f1 {}, y_r - y_f1 {}; by (4.8) {}, {}. Distance to feature 1 {}: {}. With the "
                    "first heading known: {}, {}",
                    in_words(to_1.north), in_words(to_1.east), in_words(to_1.north_by_method),
                    in_words(to_1.east_by_method), in_words(to_1.apart), course_text(to_1.distance),
                    in_words(since(oriented(), to_1.x_mode)), in_words(since(oriented(), to_1.y_mode))},
       .number =
           exactly("information about its distance at the end", at(usual(), to_1.distance, end_s), "1/m^2"),
       .why =
           "information about the distance does, and about neither coordinate. In northern and eastern axes "
           "the relative position turns with the heading, which is not observable"},
      InTruth{
          to_1.north == Since::turning && to_1.east == Since::turning && grows(to_1.x_mode, north_until_s),
          in_truth(to_1.north == Since::never && to_1.east == Since::never && to_1.apart == Since::turning &&
                   grows(to_1.distance, north_until_s))},
      ByMethod{to_1.north_by_method == Since::turning && to_1.east_by_method == Since::turning});
}

Claim relative_features() {
  const Relative both(x1, x2);
  Setup s;
  s.features.second.x() = s.features.first.x();
  const Run abreast(s);
  const Since east_abreast = since(abreast, both.y_mode);
  return tested(
      "4.6-relative-features", "Figure 4.6 (c), Example 4.6",
      "Information about the position of feature 1 relative to feature 2 increases from 10 s on in y_f1 - "
      "y_f2, east, and from 14 s on in x_f1 - x_f2, north",
      {.rule = Rule::dimension,
       .measured = {"y_f1 - y_f2 {}, x_f1 - x_f2 {}; by (4.8) {}, {}. Distance of the two {}: {}. With both "
                    "equally far north y_f1 - y_f2 {}. With the first heading known {}, {}",
                    in_words(both.east), in_words(both.north), in_words(both.east_by_method),
                    in_words(both.north_by_method), in_words(both.apart), course_text(both.distance),
                    in_words(east_abreast), in_words(since(oriented(), both.y_mode)),
                    in_words(since(oriented(), both.x_mode))},
       .number =
           exactly("information about their distance at the end", at(usual(), both.distance, end_s), "1/m^2"),
       .why = "information about their distance does, from 14 s on. Coordinates turn with the heading, which "
              "is not observable; y_f1 - y_f2 is the distance, and known from 10 s on, only where both "
              "features are equally far north"},
      InTruth{
          both.east == Since::north && both.north == Since::turning,
          in_truth(both.east == Since::never && both.north == Since::never && both.apart == Since::turning &&
                   grows(both.distance, north_until_s) && east_abreast == Since::north)},
      ByMethod{both.east_by_method == Since::north && both.north_by_method == Since::turning});
}

Claim truth_does_not_matter() {
  const Run strays(Setup{.jacobians = Jacobians::estimates});
  const RankCourse estimates = ranks_of(strays);
  const Ranks at_truth = ranks_of(usual()).at_end;
  const Direction c = state(heading);
  const double spurious = at(strays, c, 10);
  return assessed(
      "4.6-truth", "Example 4.6",
      "That Jacobians are evaluated at the truth does not affect the value of the inverse covariance; "
      "tested: at estimates that stray by 1 cm and 0.1 degrees the ranks are the same",
      {.rule = Rule::dimension,
       .measured = {"ranks at the ends of phases {} at the truth, {} at estimates, where information about "
                    "the heading is {:.2f} 1/rad^2 before the vehicle moves and {:.2f} at the end",
                    text(at_truth), text(estimates.at_end), spurious, at(strays, c, 20)},
       .number = exactly("rank at rest with Jacobians at estimates, at the truth 2", estimates.at_end[0]),
       .why = "Jacobians at different estimates of one state are inconsistent, which gives the filter "
              "information about the heading before the vehicle moves, where at the truth there is none"},
      estimates.at_end == at_truth,
      in_truth(estimates.at_end[0] > at_truth[0] && spurious > 0 && since(c) == Since::never));
}

LedgerEntry run(const ExperimentSettings& settings) {
  return entry_of(example_4_6, settings,
                  {rank_claims(), orientation(), global_modes(), relative_at_rest(), relative_2(),
                   line_of_sight(), relative_1(), relative_features(), link(), truth_does_not_matter()},
                  figures());
}

}  // namespace
}  // namespace incognita::two_bearings

const incognita::Experiment incognita::example_4_6{"4.6",
                                                   "Information of two bearings for a planar vehicle",
                                                   {"fig-4.3", "fig-4.4", "fig-4.5", "fig-4.6"},
                                                   two_bearings::run};
