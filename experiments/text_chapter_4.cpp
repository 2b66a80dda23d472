// Claims in the running text of Chapter 4 outside its examples: about the method in
// text_chapter_4_method.cpp, tested on a filter in text_chapter_4_filter.cpp, and here about the systems, at
// the heads of subsections and in the conclusions (Sections 4.4 and 7.1).
//
// Experiment: the built-in systems, motions and rules of observability_claims.hpp; also at rest,
// unaccelerated (see example_4_2.cpp), and with a camera whose accelerations are known.
#include <array>
#include <map>

#include "experiments/common.hpp"
#include "experiments/example_4_2.hpp"

namespace incognita::observability_claims {
namespace {

using inertial::Unaccelerated;

const Study& of(const std::string& system, int anchors = 0, const std::string& motion = "general") {
  return study({.system = system, .anchors = anchors, .motion = motion});
}

const Study& relative(const std::string& system, const std::string& motion = "general") {
  return study(relative_map(system, 1, motion));
}

Claim worlds() {
  Studies worlds;
  for (const char* system : {"monobot", "planar", "planar-rb", "inertial", "inertial-rb", "planar-cv", "cv6"})
    worlds.add(system, of(system));
  return studied(worlds.cases(), "text-4-world", "Sections 4.1.1 and 4.1.2",
                 "World-centric maps without anchors are partially observable in any SLAM case",
                 {.rule = Rule::dimension,
                  .measured = worlds.text(),
                  .number = number_of("fewest dimensions left by the motion itself, of seven systems",
                                      std::ranges::min(worlds.each(&Study::true_dimension)))},
                 InTruth{worlds.all(partially_observable)}, ByMethod{worlds.all(never_full)});
}

std::vector<Claim> moving_or_at_rest() {
  Studies anchored;
  const Study &moving = anchored.add("moving", of("planar", 2)),
              &rest = anchored.add("at rest", of("planar", 2, "stationary"));
  Studies still;
  for (const int anchors : {0, 1, 2, 3})
    still.add(fmt::format("{} anchor{}", anchors, anchors == 1 ? "" : "s"),
              of("planar", anchors, "stationary"));
  still.add("relative map", relative("planar", "stationary"));
  return {studied(anchored.cases(), "text-4-planar-anchors", "Section 4.1.1",
                  "With anchors (two) the planar vehicle is fully observable, as long as it translates",
                  {.rule = Rule::dimension,
                   .measured = anchored.text(),
                   .number = left_in_truth(rest, ", at rest with two anchors")},
                  InTruth{fully_observable(moving) && partially_observable(rest)},
                  ByMethod{full_in_two(moving) && never_full(rest)}),
          studied(still.cases(), "text-4-planar-at-rest", "Section 4.4",
                  "At zero velocity the planar vehicle's system simply is unobservable",
                  {.rule = Rule::dimension,
                   .measured = still.text(),
                   .number = number_of("fewest dimensions left by the motion itself, of five maps",
                                       std::ranges::min(still.each(&Study::true_dimension)))},
                  InTruth{still.all(partially_observable)}, ByMethod{still.all(never_full)})};
}

/// The relative inertial map turned about the line on which the body travels: r by v x r, and the
/// misalignment along v. All points on that line have the same measurements.
Basis turn_about_travel(const Course& c) {
  const VectorXd& x = c.points[0].x;  // velocity, angles, r
  const Vector3d v = x.head<3>(), r = x.tail<3>();
  return {(VectorXd(9) << Vector3d::Zero(), v, v.cross(r)).finished()};
}

Claim third_step() {
  const auto moved = [](Unaccelerated how, int segments) -> const Study& {
    Case which = inertial::unaccelerated(inertial::relative(), how);
    which.segments = segments;
    return study(which);
  };
  const Study &falls = moved(Unaccelerated::falls, 3), &weightless = moved(Unaccelerated::weightless, 3),
              &carried = moved(Unaccelerated::carried, 3), &on = moved(Unaccelerated::weightless, 6);
  const auto full_from = [](const Study& s, int k) {
    return dimension(s.total(k - 1)) > 0 && dimension(s.total(k)) == 0;
  };
  const bool one_for_good = for_all({3, 4, 5, 6}, [&](int k) {
    return on.stripped_spanned_by(k, turn_about_travel) && dimension(on.total(k)) == 1;
  });
  return studied(
      4, "text-4-third-step", "Section 4.4",
      "Without acceleration (f = 0) the TOM of the relative inertial map has full rank in three segments and "
      "not in two: falling, and at constant velocity",
      {.rule = Rule::dimension,
       .measured = {"left by SOM and TOM after 1/2/3 segments, and by the motion itself: {}. Without gravity "
                    "the TOM leaves the turn about the line of travel from the third to the sixth: {}",
                    inertial::by_unaccelerated(inertial::relative()), yes_no(one_for_good)},
       .number = number_of("dimensions left by the TOM of three segments, at constant velocity (f = 0 "
                           "without gravity)",
                           dimension(weightless.total(3))),
       .why = "if f = 0 means that the body falls. At constant velocity without gravity segments begin on "
              "one line, and the turn about it is left for good; under gravity f = -g, and two steps do"},
      full_from(falls, 3) && full_from(weightless, 3),
      on_condition(full_from(falls, 3) && one_for_good && full_from(carried, 2)));
}

Claim exteroceptive_only() {
  Studies lines;
  const Study &flat = lines.add("planar-cv with 2 anchors", of("planar-cv", 2)),
              &flat_rest = lines.add("at rest", of("planar-cv", 2, "stationary")),
              &space = lines.add("cv6 with 3", of("cv6", 3)),
              &space_rest = lines.add("at rest", of("cv6", 3, "stationary"));
  const Study &no_anchor = lines.add("planar-cv without", of("planar-cv")),
              &map = lines.add("relative map", relative("planar-cv")),
              &free = lines.add("cv6 without", of("cv6"));
  const auto all = [](std::initializer_list<const Study*> studies, bool (*hold)(const Study&)) {
    return std::ranges::all_of(studies, [&](const Study* s) { return hold(*s); });
  };
  const bool but_the_map =
      all({&flat, &space}, full_in_two) && all({&flat_rest, &space_rest, &no_anchor, &free}, never_full);
  return studied(lines.cases(), "text-4-only-anchors", "Section 4.1.4",
                 "Constant-velocity systems are fully observable with anchors and translation, and with "
                 "nothing else",
                 {.rule = Rule::dimension,
                  .measured = lines.text(),
                  .number = left_in_truth(map, ", of the relative map")},
                 InTruth{all({&flat, &space}, fully_observable) &&
                         all({&flat_rest, &space_rest, &no_anchor, &map, &free}, partially_observable)},
                 ByMethod{but_the_map && never_full(map), in_truth(but_the_map && map.full_rank(3))});
}

Claim scale() {
  const Vectors of_scale = named({"scale"});
  Studies without("without anchors");
  for (const char* system : {"planar-cv", "cv6"}) without.add(system, of(system));
  const Study& map = without.add("relative map", relative("planar-cv"));
  const bool anchored = fully_observable(of("planar-cv", 2)) && fully_observable(of("cv6", 3));
  const auto stays = [&](const Study& s) { return contain(s.total(3), s.courses(), of_scale); };
  const bool by_matrices = full_in_two(of("planar-cv", 2)) && full_in_two(of("cv6", 3)),
             always = without.all([&](const Study&s) { return s.along_contains(of_scale); });
  return studied(
      without.cases() + 2, "text-4-scale", "Section 7.1",
      "Without proprioceptive sensors only anchors recover the scale: it is left without them",
      {.rule = Rule::dimension,
       .measured = {"{}; scaling all is left by the motion itself: {}, by the TOM of three "
                    "segments: {}",
                    without.text(), always ? "always" : "not always",
                    without.all(stays) ? "always" : "not always"},
       .number = left_in_truth(map, ", of the relative map, scale among them")},
      InTruth{anchored && always},
      ByMethod{by_matrices && without.all(stays),
               in_truth(by_matrices && map.full_rank(3) && seen_by_frozen_rows_only(map, of_scale))});
}

/// How many velocities are among the states.
int velocities_of(const std::vector<std::string>& states) {
  return static_cast<int>(std::ranges::count_if(
      states, [](const std::string& s) { return (s[0] == 'v' || s[0] == 'w') && s.back() != '?'; }));
}

/// Of the velocities, with 1, 2 and 3 anchors, those that one segment recovers.
struct RecoveredVelocities {
  int all;
  std::vector<int> along, by_Q_1;

  explicit RecoveredVelocities(const std::string& system) {
    for (const int anchors : {1, 2, 3}) {
      const Study& s = study({.system = system, .anchors = anchors, .segments = 1});
      all = velocities_of(s.states());
      along.push_back(velocities_of(s.observable_along()));
      by_Q_1.push_back(velocities_of(s.observable(1)));
    }
  }
  /// From so many anchors on they are recovered, with fewer not all.
  bool from(int anchors, const std::vector<int>& recovered) const {
    for (int n = 1; n <= 3; ++n)
      if ((recovered[static_cast<std::size_t>(n - 1)] == all) != (n >= anchors)) return false;
    return true;
  }
};

Claim cv_velocities() {
  const RecoveredVelocities plane("planar-cv"), space("cv6");
  return studied(
      6, "text-4-cv-velocities", "Section 4.4",
      "With anchors one segment recovers the velocities of the constant-velocity models",
      {.rule = Rule::dimension,
       .measured = {"velocities recovered in one segment with 1/2/3 anchors, on the plane {} of {} by "
                    "the motion itself and {} by Q_1; in space {} of {}, and {}",
                    joined(plane.along), plane.all, joined(plane.by_Q_1), joined(space.along), space.all,
                    joined(space.by_Q_1)},
       .number = exactly("velocities of three that one segment recovers on the plane with one anchor",
                         plane.along[0]),
       .why = "with two anchors or more on the plane, and three in space; by Q_1 with two in both"},
      InTruth{plane.from(1, plane.along) && space.from(1, space.along),
              on_condition(plane.from(2, plane.along) && space.from(3, space.along))},
      ByMethod{plane.from(1, plane.by_Q_1) && space.from(1, space.by_Q_1),
               on_condition(plane.from(2, plane.by_Q_1) && space.from(2, space.by_Q_1))});
}

void known_acceleration(SystemText& text) {
  text.disturbed.clear();
  text.inputs = {{"fx", {}, -1, 1}, {"fy", {}, -1, 1}, {"alpha", {}, -0.5, 0.5}};
  const std::map<std::string, std::string> by{{"vx", "fx"}, {"vy", "fy"}, {"wz", "alpha"}};
  for (NamedExpression& state : text.vehicle.states)
    if (by.contains(state.name)) state.expression.text = by.at(state.name);
}

Claim accelerations() {
  Studies lines;
  const Study &changing = lines.add("changing velocities", of("planar-cv")),
              &constant = lines.add("constant velocities", of("planar-cv", 0, "unaccelerated"));
  const Study &measured = lines.add("known accelerations",
                                    study({.system = "planar-cv", .change = {"known", known_acceleration}})),
              &rest = lines.add("two anchors at rest", of("planar-cv", 2, "stationary"));
  const bool unknown_do_not =
      changing.true_dimension() == constant.true_dimension() && partially_observable(rest);
  return studied(
      lines.cases(), "text-4-accelerations", "Section 4.4",
      "In constant-velocity models the accelerations, known inputs or not, do not affect observability; zero "
      "velocity does",
      {.rule = Rule::dimension,
       .measured = lines.text(),
       .number = left_in_truth(measured, ", with known accelerations"),
       .why = "if they are unknown noise. As known inputs they make lengths and directions observable, so "
              "that only the translations are left"},
      InTruth{unknown_do_not && measured.true_dimension() == constant.true_dimension(),
              on_condition(unknown_do_not && measured.along_spanned_by(named({"translation"})))},
      ByMethod{changing.dimensions() == constant.dimensions() &&
               measured.dimensions() == constant.dimensions() && never_full(rest)});
}

Claim lower_limit() {
  const Vectors translations = named({"translation"});
  Cases settles;
  bool along = true, by_matrices = true;
  for (const char* system : {"planar", "inertial", "planar-cv", "cv6"}) {
    const Study &s = study({.system = system, .segments = 5}), &three = of(system);
    const auto left = s.total_dimensions();
    settles.add({{"{} {}", system, s.numbers()}, left[2] == left[3] && left[3] == left[4] && left[4] > 0});
    by_matrices = by_matrices && contain(s.total(5), s.courses(), translations);
    along = along && s.true_dimension() == three.true_dimension() && s.along_contains(translations);
  }
  return studied(
      8, "text-4-lower-limit", "Section 4.4",
      "World-centric maps reach a lower limit of unobservable modes, the global position among "
      "them: three segments leave as many as five, the translations among them",
      {.rule = Rule::dimension,
       .measured = {"dimensions left by SOM and TOM after 1/2/3/4/5 segments, and by the motion "
                    "itself of five: {}; translations among them: {} and {}",
                    settles.text(), yes_no(by_matrices), yes_no(along)},
       .number = left_in_truth(study({.system = "planar", .segments = 5}), " of five segments, planar")},
      InTruth{along}, ByMethod{settles.hold() && by_matrices});
}

Claim becomes_observable() {
  Studies lines;
  const Study &flat = lines.add("planar with 2 anchors", of("planar", 2)),
              &space = lines.add("inertial with 2 anchors", of("inertial", 2)),
              &flat_map = lines.add("planar, relative map", relative("planar")),
              &space_map = lines.add("inertial, relative map", relative("inertial"));
  const bool anchors = fully_observable(flat) && fully_observable(space);
  return studied(lines.cases(), "text-4-observable", "Sections 4.4 and 7.1",
                 "Anchors, or a sensor-centric map with proprioceptive sensors, make the system fully "
                 "observable under a suitable motion",
                 {.rule = Rule::dimension,
                  .measured = lines.text(),
                  .number = left_in_truth(flat_map, ", of the relative map on the plane"),
                  .why = "anchors do. The sensor-centric map keeps one direction, heading and map turned "
                         "(about the vertical), which no motion makes observable"},
                 InTruth{anchors && fully_observable(flat_map) && fully_observable(space_map),
                         in_truth(anchors && flat_map.along_spanned_by(named({"rotation"})) &&
                                  space_map.along_spanned_by(named({"rotation about z"})))},
                 ByMethod{lines.all(full_in_two)});
}

LedgerEntry run_text_chapter_4(const ExperimentSettings& settings) {
  return entry_of(
      text_chapter_4, settings,
      {method_claims(), worlds(), moving_or_at_rest(), third_step(), exteroceptive_only(), scale(),
       cv_velocities(), accelerations(), lower_limit(), becomes_observable(), filter_claims(settings.seeds)});
}

}  // namespace
}  // namespace incognita::observability_claims

const incognita::Experiment incognita::text_chapter_4{
    "text-4", "Claims in the text of Chapter 4", {}, observability_claims::run_text_chapter_4};
