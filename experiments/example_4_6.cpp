// Example 4.6: what a vehicle of the plane gets to know of itself and of two features by their bearings.
//
// Experiment: example_4_6_filter.hpp, features 15 m ahead and 17 m to the north-east, a look every 0.1 s.
// The thesis prints neither noises nor places. So all is done again with process noise times 0, 0.1, 1 and 10
// and bearing noise times 0.1, 1 and 10, with steps of 0.05 and 0.5 s, and with 20 random pairs of features
// (10 to 40 m ahead; 8 to 40 m off, 30 to 60 degrees to the east). No chance beyond that: Jacobians at the
// truth need no measurements.
// Measured: ranks, and marginal information of states, of the modes of Figure 4.6 and of distances, after
// each look. Holds: a rank when all looks of a phase have it in all settings, with at least a factor of 1000
// (a million in the information) between the singular value that counts least and the next; information is
// zero when more than 1e-7 of a direction is outside the information's range (the look is in doubt between
// 1e-8 and 1e-6), and there `from` a phase on when it is zero at all looks before and at none after.
// Corrected by the same rules: with another number, or with the distance for coordinates in axes that nothing
// fixes.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "experiments/evidence.hpp"
#include "experiments/example_4_6_filter.hpp"
#include "experiments/list.hpp"
#include "incognita/math/angles.hpp"
#include "incognita/math/random.hpp"

namespace incognita::two_bearings {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

constexpr double a_bit_s = 1e-6;

std::vector<Setup> settings_to_try() {
  std::vector<Setup> all;
  const Noise usual;
  for (const double process : {0.0, 0.1, 1.0, 10.0})
    for (const double bearing : {0.1, 1.0, 10.0}) {
      Setup s;
      s.noise = {process * usual.sigma_speed_mps, process * usual.sigma_turn_radps,
                 bearing * usual.sigma_bearing_rad};
      all.push_back(s);
    }
  for (const double dt : {0.05, 0.5}) all.push_back({.dt_s = dt});
  RandomStream random(1, "features");
  for (int i = 0; i < 20; ++i) {
    Setup s;
    s.features.first = {random.uniform(10, 40), 0};
    const double distance = random.uniform(8, 40), direction = radians(random.uniform(30, 60));
    s.features.second = distance * Vector2d(std::cos(direction), std::sin(direction));
    all.push_back(s);
  }
  return all;
}

/// All of them, the usual one not least; made once.
const std::vector<Run>& runs() {
  static const std::vector<Run> all = [] {
    std::vector<Run> made;
    for (const Setup& s : settings_to_try()) made.emplace_back(s);
    return made;
  }();
  return all;
}

const Run& usual() {
  static const Run run{Setup{}};
  return run;
}

int count(const std::vector<Run>& all) { return static_cast<int>(all.size()); }

// Ranks -----------------------------------------------------------------------------------------------

constexpr int phases = 3;  // at rest, to the north, turning

int phase_of(double t_s) {
  return t_s <= at_rest_until_s + a_bit_s ? 0 : t_s <= north_until_s + a_bit_s ? 1 : 2;
}

using Ranks = std::array<int, phases>;

struct RankCourse {
  Ranks at_end = {};       ///< of each phase
  bool throughout = true;  ///< the same from each phase's first look on
  bool clear = true;       ///< all looks
  double least_kept = 1;   ///< singular values, of the largest
  double most_left_out = 1e-300;
  bool is(const Ranks& expected) const { return at_end == expected && throughout && clear; }
  void take(const RankCourse& other) {
    throughout = throughout && other.throughout && at_end == other.at_end;
    clear = clear && other.clear;
    least_kept = std::min(least_kept, other.least_kept);
    most_left_out = std::max(most_left_out, other.most_left_out);
  }
};

RankCourse ranks_of(const std::vector<Knowledge>& known, const std::vector<Instant>& drive) {
  RankCourse course;
  for (std::size_t k = 0; k < known.size(); ++k) course.at_end[phase_of(drive[k].t_s)] = known[k].rank.rank;
  for (std::size_t k = 0; k < known.size(); ++k) {
    const Rank& r = known[k].rank;
    const VectorXd relative = r.singular_values / r.singular_values[0];
    course.throughout = course.throughout && r.rank == course.at_end[phase_of(drive[k].t_s)];
    course.clear = course.clear && known[k].clear();
    course.least_kept = std::min(course.least_kept, relative[r.rank - 1]);
    if (r.rank < relative.size()) course.most_left_out = std::max(course.most_left_out, relative[r.rank]);
  }
  return course;
}

RankCourse ranks_of(const Run& run) { return ranks_of(run.known, run.drive); }

RankCourse ranks_of_all() {
  RankCourse all = ranks_of(runs().front());
  for (const Run& run : runs()) all.take(ranks_of(run));
  return all;
}

std::string text(const Ranks& ranks) { return fmt::format("{}", fmt::join(ranks, ", ")); }

std::string text(const RankCourse& course) {
  if (!course.throughout || !course.clear)
    return text(course.at_end) + " at the ends of phases, not throughout";
  return text(course.at_end);
}

RankCourse ranks_with(Jacobians jacobians) { return ranks_of(Run({.jacobians = jacobians})); }

// Information -----------------------------------------------------------------------------------------

/// Since when there is information: zero at all looks before, at none after, and no look in doubt.
enum class Since { start, north, turning, never, unclear };

bool in_doubt(const Knowledge& known, const VectorXd& c) {
  const double outside = known.outside(c);
  return !known.clear() || (outside > 0.1 * outside_tolerance && outside < 10 * outside_tolerance);
}

Since since(const Run& run, const Direction& c) {
  for (std::size_t k = 0; k < run.known.size(); ++k)
    if (in_doubt(run.known[k], c(run, k))) return Since::unclear;
  const std::vector<double> known = information(run, c);
  const auto positive = [](double v) { return v > 0; };
  const auto first = std::find_if(known.begin(), known.end(), positive);
  if (first == known.end()) return Since::never;
  if (!std::all_of(first, known.end(), positive)) return Since::unclear;
  const auto k = static_cast<std::size_t>(first - known.begin());
  if (k == 0) return Since::start;
  const int phase = phase_of(run.drive[k].t_s);
  if (phase == phase_of(run.drive[k - 1].t_s)) return Since::unclear;
  return phase == 1 ? Since::north : Since::turning;
}

/// The same in all settings, else unclear.
Since since(const Direction& c) {
  const Since first = since(usual(), c);
  for (const Run& run : runs())
    if (since(run, c) != first) return Since::unclear;
  return first;
}

std::string text(Since since) {
  switch (since) {
    case Since::start:
      return "from the start";
    case Since::north:
      return "from the first look after 10 s";
    case Since::turning:
      return "from the first look after 14 s";
    case Since::never:
      return "never";
    case Since::unclear:
      break;
  }
  return "not the same in all settings";
}

/// Largest over all settings and looks up to a time.
double most(const Direction& c, double until_s = end_s) {
  double value = 0;
  for (const Run& run : runs()) {
    const std::vector<double> known = information(run, c);
    for (std::size_t k = 0; k < known.size() && run.drive[k].t_s <= until_s + a_bit_s; ++k)
      value = std::max(value, known[k]);
  }
  return value;
}

/// Least share of a direction, over all settings and looks, that is in what nothing is known of.
double least_outside(const Direction& c) {
  double value = 1;
  for (const Run& run : runs())
    for (std::size_t k = 0; k < run.known.size(); ++k)
      value = std::min(value, run.known[k].outside(c(run, k)));
  return value;
}

double at(const Run& run, const Direction& c, double t_s) {
  const std::size_t k = run.look_at(t_s);
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

// Claims ----------------------------------------------------------------------------------------------

Claim rank_claim() {
  const RankCourse all = ranks_of_all(), late = ranks_with(Jacobians::odometry_late),
                   measured = ranks_with(Jacobians::measured_speed),
                   segments = ranks_of(stripped(usual().setup), usual().drive);
  const Ranks printed{2, 4, 5};
  return assessed(
      {.id = "4.6-rank",
       .place = "Figure 4.4, Example 4.6",
       .statement = "Rank of the information matrix at rest, while moving north, while turning to the east",
       .printed = text(printed),
       .measured = fmt::format(
           "{}, each from the first look of its phase on, in {} settings of noises, steps and features "
           "(singular values of the root, of the largest: kept from {:.1e} on, left out {}). The stripped "
           "matrix (4.8), each step a segment: {}. The filter with F of the step before: {}; with F by "
           "encoders' speeds 2 % off: {}; with H where the vehicle was a step ago, at the ends of phases: "
           "{}; "
           "with F along the tangent: {}",
           text(all), count(runs()), all.least_kept, below(all.most_left_out), text(segments), text(late),
           text(measured), text(ranks_with(Jacobians::looks_late).at_end),
           text(ranks_with(Jacobians::along_tangent))),
       .why =
           "2, 3, 4: moving north adds one, the distance to feature 2, and turning one, that to feature 1. "
           "What is printed is the rank of (4.8), which freezes H inside a segment; a filter comes to it "
           "when its F and H are not those of one and the same motion. Which of these the thesis did is "
           "not told",
       .runs = count(runs())},
      all.is(printed), all.is({2, 3, 4}) && segments.is(printed) && late.is(printed) && measured.is(printed));
}

Claim at_rest_rank() {
  bool none_alone = true;
  for (int i = 0; i < states; ++i)
    none_alone = none_alone && most(constantly(state(i)), at_rest_until_s) == 0;
  const RankCourse all = ranks_of_all();
  return assessed(
      {.id = "4.6-stationary",
       .place = "below Figure 4.4, Example 4.6",
       .statement = "At rest only two states are observable, combinations of the positions of vehicle "
                    "and features and of the heading: rank 2, and nothing about any state alone",
       .printed = "2",
       .measured = fmt::format("rank {}; largest marginal information of a state: {}", all.at_end[0],
                               none_alone ? "0" : "above 0"),
       .runs = count(runs())},
      all.throughout && all.clear && all.at_end[0] == 2 && none_alone);
}

/// Columns in units: everything moved north, moved east, turned about the origin.
MatrixXd rigid_motions(const Run& run, std::size_t measurement) {
  const auto& [first, second] = run.setup.features;
  const auto& pose = run.drive[measurement].pose;
  MatrixXd all = MatrixXd::Zero(states, 3);
  for (const int i : {x, x1, x2}) all(i, 0) = 1, all(i + 1, 1) = 1;
  all.col(2) << Vector2d(-pose.y(), pose.x()) / unit_m, 1, Vector2d(-first.y(), first.x()) / unit_m,
      Vector2d(-second.y(), second.x()) / unit_m;
  return all;
}

/// Largest share of a column that is not among what nothing is known of.
double not_among(const MatrixXd& columns, const MatrixXd& unobservable) {
  const MatrixXd rest = columns - unobservable * (unobservable.transpose() * columns);
  return (rest.colwise().norm().array() / columns.colwise().norm().array()).maxCoeff();
}

Claim deficiency() {
  double modes = 0, turned = 0;
  int most_missing = 0, least_missing = states;
  for (const Run& run : runs()) {
    const Knowledge& last = run.known.back();
    const MatrixXd rigid = rigid_motions(run, run.drive.size() - 1);
    modes = std::max(modes, not_among(rigid.leftCols(2), last.unobservable));
    turned = std::max(turned, not_among(rigid.rightCols(1), last.unobservable));
    const int missing = states - last.rank.rank;
    most_missing = std::max(most_missing, missing), least_missing = std::min(least_missing, missing);
  }
  constexpr double same = 1e-9;
  return assessed(
      {.id = "4.6-deficiency",
       .place = "Figure 4.4, Example 4.6",
       .statement = "After 14 s a rank deficiency of two remains: the modes of (4.20), place of the whole to "
                    "the north and to the east (to 1e-9)",
       .printed = "2",
       .measured =
           fmt::format("{} at the end in {} settings. Not among what nothing is known of: of (4.20) {}, "
                       "of a turn of everything about the origin {}",
                       most_missing, count(runs()), below(modes), below(turned)),
       .why = "3: the modes of (4.20) and a turn of everything, which changes no bearing either",
       .runs = count(runs())},
      most_missing == 2 && least_missing == 2 && modes <= same,
      most_missing == 3 && least_missing == 3 && modes <= same && turned <= same);
}

Claim orientation() {
  const Direction c = constantly(state(heading));
  const Since when = since(c);
  const std::vector<double> given = information(oriented(), c);
  const auto by = [&](Jacobians jacobians, double dt) {
    return at(Run({.dt_s = dt, .jacobians = jacobians}), c, end_s);
  };
  return assessed(
      {.id = "4.6-orientation",
       .place = "Figure 4.5, Example 4.6",
       .statement = "The orientation becomes observable when the vehicle moves: its marginal information is "
                    "zero until 10 s and then increases",
       .printed = "increases from 10 s",
       .measured = fmt::format(
           "above zero: {}; in all of {} settings at least {:.2f} of the heading's direction are in what "
           "nothing is known of. With the first heading known to 0.02 rad it falls from {:.0f} to {:.0f} "
           "1/rad^2, {:.0f} at most. With odometry of the step before {:.2f} 1/rad^2 "
           "at the end, and {:.2f} with half the step",
           text(when), count(runs()), least_outside(c), given.front(), given.back(),
           *std::max_element(given.begin(), given.end()), by(Jacobians::odometry_late, 0.1),
           by(Jacobians::odometry_late, 0.05)),
       .why = "turning vehicle, path and features together changes neither bearings nor odometry, so nothing "
              "can tell the heading, as Example 4.5 says itself. What grows is an artefact of Jacobians of "
              "different instants, and depends on the step",
       .runs = count(runs())},
      when == Since::north && grows(c, at_rest_until_s));
}

Claim global_modes() {
  const Direction north = constantly(state(x) + state(x1) + state(x2)),
                  east = constantly(state(y) + state(y1) + state(y2));
  const Since of_north = since(north), of_east = since(east);
  return assessed(
      {.id = "4.6-global-modes",
       .place = "Figure 4.6 (a), Example 4.6",
       .statement = "Information of the modes x_r + sum x_f and y_r + sum y_f remains zero",
       .printed = "0",
       .measured = fmt::format("above zero: {}, {}; at least {:.2f} and {:.2f} of these directions are "
                               "in what nothing is known of",
                               text(of_north), text(of_east), least_outside(north), least_outside(east)),
       .runs = count(runs())},
      of_north == Since::never && of_east == Since::never);
}

Claim relative_at_rest() {
  double value = 0;
  for (const auto& c : {difference(x, x1), difference(y, y1), difference(x, x2), difference(y, y2),
                        difference(x1, x2), difference(y1, y2)})
    value = std::max(value, most(constantly(c), at_rest_until_s));
  double distances = 0;
  for (const Direction& c : {Direction(distance_to_1), Direction(distance_to_2), Direction(distance_between)})
    distances = std::max(distances, most(c, at_rest_until_s));
  return assessed(
      {.id = "4.6-relative-at-rest",
       .place = "Figure 4.6 (b), (c), Example 4.6",
       .statement = "Before the vehicle moves there is no information about the position of features "
                    "relative to the vehicle or to each other",
       .printed = "0",
       .measured = fmt::format("largest up to 10 s: {:.2g} 1/m^2 of coordinates, {:.2g} of distances", value,
                               distances),
       .runs = count(runs())},
      value == 0 && distances == 0);
}

Claim relative_2() {
  const Since north = since(constantly(difference(x, x2))), east = since(constantly(difference(y, y2))),
              distance = since(distance_to_2);
  return assessed(
      {.id = "4.6-relative-2",
       .place = "below Figure 4.5, Example 4.6",
       .statement =
           "While the vehicle moves north the position of feature 2 relative to it is observable, by "
           "looks from different places",
       .printed = "from 10 s",
       .measured = fmt::format("x_r - x_f2 {}, y_r - y_f2 {}; distance to feature 2 {}: {}", text(north),
                               text(east), text(distance), course_text(distance_to_2)),
       .why =
           "the distance is. In northern and eastern axes the relative position turns with the heading, of "
           "which nothing is known",
       .runs = count(runs())},
      north == Since::north && east == Since::north, distance == Since::north);
}

Claim line_of_sight() {
  const double ahead = most(distance_to_1, north_until_s);
  std::vector<std::string> lines;
  bool off_is_known = true;
  std::vector<double> offs{0.01, 0.1, 1, 10}, values;
  for (const double off : offs) {
    Setup s;
    s.features.first = 15 * Vector2d(std::cos(radians(off)), std::sin(radians(off)));
    const Run run(s);
    const Knowledge& last = run.known[run.look_at(north_until_s)];
    values.push_back(at(run, distance_to_1, north_until_s));
    off_is_known = off_is_known && last.rank.rank == 4 && last.clear() && values.back() > 0;
    lines.push_back(fmt::format("{}: rank {}, {:.2g} 1/m^2", off, last.rank.rank, values.back()));
  }
  return assessed(
      {.id = "4.6-line-of-sight",
       .place = "below Figure 4.5, Example 4.6",
       .statement =
           "The relative north position of feature 1 is not observable while the vehicle moves along "
           "the line of sight to it: nothing about its distance until 14 s, and something when it is "
           "beside the line",
       .printed = "0",
       .measured =
           fmt::format("largest up to 14 s: {:.2g} 1/m^2, rank {}. At 14 s with feature 1 so many "
                       "degrees beside: {}; as angle^{:.2f}",
                       ahead, ranks_of_all().at_end[1], fmt::join(lines, "; "), exponent_of(offs, values)),
       .runs = count(runs())},
      ahead == 0 && most(constantly(difference(x, x1)), north_until_s) == 0 && off_is_known);
}

Claim relative_1() {
  const Direction x_mode = constantly(difference(x, x1)), y_mode = constantly(difference(y, y1));
  const Since north = since(x_mode), east = since(y_mode), distance = since(distance_to_1);
  return assessed(
      {.id = "4.6-relative-1",
       .place = "Figure 4.6 (b), Example 4.6",
       .statement =
           "Only after the vehicle turns to the east does information about the position of feature 1 "
           "relative to it, x_r - x_f1 and y_r - y_f1, start to increase",
       .printed = "from 14 s",
       .measured = fmt::format(
           "x_r - x_f1 {}, y_r - y_f1 {}; distance to feature 1 {}: {}. With the first heading known: x_r - "
           "x_f1 {}, y_r - y_f1 {}",
           text(north), text(east), text(distance), course_text(distance_to_1),
           text(since(oriented(), x_mode)), text(since(oriented(), y_mode))),
       .why = "information about the distance does. In northern and eastern axes the relative position turns "
              "with the heading, of which nothing is known",
       .runs = count(runs())},
      north == Since::turning && east == Since::turning && grows(x_mode, north_until_s),
      distance == Since::turning && grows(distance_to_1, north_until_s));
}

Claim relative_features() {
  const Direction x_mode = constantly(difference(x1, x2)), y_mode = constantly(difference(y1, y2));
  const Since north = since(x_mode), east = since(y_mode), distance = since(distance_between);
  Setup s;
  s.features.second.x() = s.features.first.x();
  const Run abreast(s);
  return assessed(
      {.id = "4.6-relative-features",
       .place = "Figure 4.6 (c), Example 4.6",
       .statement =
           "Information about the position of feature 1 relative to feature 2 increases from 10 s on "
           "in y_f1 - y_f2, east, and from 14 s on in x_f1 - x_f2, north",
       .printed = "from 10 s; from 14 s",
       .measured = fmt::format(
           "y_f1 - y_f2 {}, x_f1 - x_f2 {}; distance of the two {}: {}. With both features "
           "equally far north: y_f1 - y_f2 {}, x_f1 - x_f2 {}. With the first heading known: {}, {}",
           text(east), text(north), text(distance), course_text(distance_between),
           text(since(abreast, y_mode)), text(since(abreast, x_mode)), text(since(oriented(), y_mode)),
           text(since(oriented(), x_mode))),
       .why = "information about their distance does, from 14 s on. Coordinates turn with the heading, of "
              "which nothing is known; y_f1 - y_f2 is the distance, and known from 10 s on, only where both "
              "features are equally far north",
       .runs = count(runs())},
      east == Since::north && north == Since::turning,
      distance == Since::turning && grows(distance_between, north_until_s));
}

/// How many looks of all settings have another rank than the information matrix.
int differing(std::vector<Knowledge> (*of)(const Setup&)) {
  int measurements = 0;
  for (const Run& run : runs()) {
    const std::vector<Knowledge> other = of(run.setup);
    for (std::size_t k = 0; k < other.size(); ++k)
      measurements += !other[k].clear() || other[k].rank.rank != run.known[k].rank.rank ? 1 : 0;
  }
  return measurements;
}

Claim link() {
  int measurements = 0;
  for (const Run& run : runs()) measurements += static_cast<int>(run.known.size());
  const int segments = differing(stripped), motion = differing(along_the_motion);
  return assessed(
      {.id = "4.6-link",
       .place = "Section 4.3, above Example 4.6",
       .statement = "The rank of the information matrix at any point is directly linked to that of the "
                    "observability matrix of the system; tested: it is the same after each look",
       .printed = "",
       .measured =
           fmt::format("of {} looks in {} settings it differs at {} from that of (4.8), each step a "
                       "segment, and at {} from that of [H_0; H_1 F_0; H_2 F_1 F_0; ...] along the motion",
                       measurements, count(runs()), segments, motion),
       .why = "to that along the motion, not to the chapter's (4.8)",
       .runs = count(runs())},
      segments == 0, motion == 0);
}

Claim truth_does_not_matter() {
  const Run strays(Setup{.jacobians = Jacobians::estimates});
  const RankCourse estimates = ranks_of(strays);
  const Ranks at_truth = ranks_of(usual()).at_end;
  const Direction c = constantly(state(heading));
  return assessed(
      {.id = "4.6-truth",
       .place = "Example 4.6",
       .statement =
           "That Jacobians are evaluated at the truth does not affect the value of the inverse "
           "covariance; tested: at estimates that stray by 1 cm and 0.1 degrees the ranks are the same",
       .printed = "not affected",
       .measured =
           fmt::format("ranks at the ends of phases {} at the truth, {} at estimates, where information "
                       "about the heading is {:.2f} 1/rad^2 before the vehicle moves and {:.2f} at the end",
                       text(at_truth), text(estimates.at_end), at(strays, c, 10), at(strays, c, 20)),
       .why =
           "Jacobians at different estimates of one state contradict each other, and the filter takes that "
           "for information about the heading: the over-confidence of the EKF, which the truth does not "
           "show"},
      estimates.at_end == at_truth);
}

LedgerEntry run(const ExperimentSettings& settings) {
  LedgerEntry entry{example_4_6.id, example_4_6.title, "", {}, {}};
  entry.claims = {rank_claim(),   at_rest_rank(),      deficiency(), orientation(),
                  global_modes(), relative_at_rest(),  relative_2(), line_of_sight(),
                  relative_1(),   relative_features(), link(),       truth_does_not_matter()};
  for (const Plot& plot : figures()) entry.figures.push_back(draw_plot(settings.out, plot, nullptr));
  return entry;
}

}  // namespace
}  // namespace incognita::two_bearings

namespace incognita {

const Experiment example_4_6{"4.6",
                             "What two bearings tell a vehicle of the plane",
                             {"fig-4.3", "fig-4.4", "fig-4.5", "fig-4.6"},
                             two_bearings::run};

}  // namespace incognita
