// Claims in the running text of Chapter 4 outside its examples: about the method in
// text_chapter_4_method.cpp, and here about the systems, at the heads of subsections and in the conclusion
// (Section 4.4).
//
// Experiment: the built-in systems, motions and rules of observability_claims.hpp; also at rest,
// unaccelerated (see example_4_2.cpp), and with a camera whose accelerations are known. That a system becomes
// observable is assessed by the motion itself as well.
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

std::vector<Claim> partial_or_not() {
  Studies worlds;
  for (const char* system : {"monobot", "planar", "planar-rb", "inertial", "inertial-rb", "planar-cv", "cv6"})
    worlds.add(system, of(system));
  Studies anchored;
  const Study &moving = anchored.add("moving", of("planar", 2)),
              &rest = anchored.add("at rest", of("planar", 2, "stationary"));
  Studies still;
  for (const int anchors : {0, 1, 2, 3})
    still.add(fmt::format("{} anchor{}", anchors, anchors == 1 ? "" : "s"),
              of("planar", anchors, "stationary"));
  still.add("relative map", relative("planar", "stationary"));
  return {studied(worlds.cases(), "text-4-world", "Sections 4.1.1 and 4.1.2",
                  "World-centric maps without anchors are partially observable in any SLAM case",
                  {.printed = "partially", .measured = worlds.text()}, worlds.all(remains_partial)),
          studied(anchored.cases(), "text-4-planar-anchors", "Section 4.1.1",
                  "With anchors (two) the planar vehicle is fully observable, as long as it translates",
                  {.printed = "fully", .measured = anchored.text()},
                  observable_in_two(moving) && remains_partial(rest)),
          studied(still.cases(), "text-4-planar-at-rest", "Section 4.4",
                  "At zero velocity the planar vehicle's system simply is unobservable",
                  {.printed = "unobservable", .measured = still.text()}, still.all(remains_partial))};
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
      "Without acceleration the inertial model becomes one of constant velocity, and takes a third step to "
      "full rank of the TOM (relative map)",
      {.printed = "third",
       .measured = {"{}: {}. Without gravity the TOM leaves {} after 1/2/3/4/5/6 segments, and the SOM from "
                    "the third on the turn about the line of travel: {}",
                    legend, inertial::by_unaccelerated(inertial::relative()), joined(on.total_dimensions()),
                    yes_no(one_for_good)},
       .why = "with f = 0 when it falls. At constant velocity its segments begin on one line, and one "
              "direction remains unobservable, the turn about it; under gravity f = -g, and two steps do"},
      full_from(falls, 3) && full_from(weightless, 3),
      full_from(falls, 3) && one_for_good && full_from(carried, 2));
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
  const bool in_truth = observable_in_two(flat) && observable_in_two(space) &&
                        std::ranges::all_of(std::array{&flat_rest, &space_rest, &no_anchor, &map, &free},
                                            [](const Study* s) { return s->true_dimension() > 0; });
  const bool but_one = std::ranges::all_of(std::array{&flat_rest, &space_rest, &no_anchor, &free},
                                           [](const Study* s) { return s->rank_deficient(3); });
  return studied(
      lines.cases(), "text-4-only-anchors", "Section 4.1.4",
      "Constant-velocity systems are fully observable with anchors and translation, and with nothing else",
      {.printed = "anchors only",
       .measured = lines.text(),
       .why = "so it is for the motion itself. SOM and TOM of three segments have full rank for the relative "
              "map as well"},
      in_truth && but_one && map.rank_deficient(3), in_truth && but_one && map.full_rank(3));
}

Claim cv_velocities() {
  Cases always;
  bool from_two = true;
  const auto is_velocity = [](const std::string& state) { return state[0] == 'v' || state[0] == 'w'; };
  for (const char* system : {"planar-cv", "cv6"})
    for (const int anchors : {1, 2, 3}) {
      const Study& s = of(system, anchors);
      const auto recovered = std::ranges::count_if(s.observable(1), is_velocity),
                 wanted = std::ranges::count_if(s.error_states(), is_velocity);
      always.add({{"{}, {}: {} of {}", system, anchors, recovered, wanted}, recovered == wanted});
      from_two = from_two && (anchors == 1 ? recovered == 0 : recovered == wanted);
    }
  return studied(6, "text-4-cv-velocities", "Section 4.4",
                 "With anchors one segment recovers the velocities of the constant-velocity models",
                 {.printed = "recovered",
                  .measured = {"velocities outside N(Q_1) with one feature in {} motions, by anchors: {}",
                               motions, always.text()},
                  .why = "from two anchors on"},
                 always.hold(), from_two);
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
  const bool unknown_do_not = changing.dimensions() == constant.dimensions() &&
                              changing.true_dimension() == constant.true_dimension() &&
                              rest.true_dimension() > 0;
  return studied(
      lines.cases(), "text-4-accelerations", "Section 4.4",
      "In constant-velocity models the accelerations, inputs to the system, do not affect observability; "
      "zero velocity does",
      {.printed = "do not",
       .measured = lines.text(),
       .why = "as noise, which they are here. As known inputs they would make lengths and directions "
              "observable"},
      unknown_do_not && measured.true_dimension() == constant.true_dimension(),
      unknown_do_not && measured.along_spanned_by(named({"translation"})));  // neither a turn nor a scale
}

Claim lower_limit() {
  Cases settles;
  bool always = true;
  for (const char* system : {"planar", "inertial", "planar-cv", "cv6"}) {
    const Study& s = study({.system = system, .segments = 6});
    const auto left = s.total_dimensions();
    settles.add(
        {{"{} {}", system, s.segments_text()}, left[2] == left[3] && left[3] == left[5] && left[5] > 0});
    always = always && contain(s.total(6), s.courses(), named({"translation"})) &&
             of(system).along_contains(named({"translation"}));
  }
  return studied(4, "text-4-lower-limit", "Section 4.4",
                 "World-centric maps reach a lower limit of unobservable modes; the global position is among "
                 "them however many segments",
                 {.printed = "a limit",
                  .measured = {"dimensions left by SOM and TOM after 1/2/3/4/5/6 segments: {}; translations "
                               "among them, and left by the motion itself: {}",
                               settles.text(), always ? "always" : "not always"}},
                 settles.hold() && always);
}

Claim becomes_observable() {
  Studies lines;
  const Study &flat = lines.add("planar with 2 anchors", of("planar", 2)),
              &space = lines.add("inertial with 2 anchors", of("inertial", 2)),
              &flat_relative = lines.add("planar, relative map", relative("planar")),
              &space_relative = lines.add("inertial, relative map", relative("inertial"));
  const bool anchors = fully_observable(flat) && fully_observable(space);
  return studied(lines.cases(), "text-4-observable", "Section 4.4",
                 "Anchors, or a sensor-centric map with proprioceptive sensors, make the system fully "
                 "observable under a suitable motion",
                 {.printed = "both",
                  .measured = lines.text(),
                  .why = "anchors do. The sensor-centric map keeps one direction, heading and map turned "
                         "(about the vertical)"},
                 anchors && fully_observable(flat_relative) && fully_observable(space_relative),
                 anchors && flat_relative.along_spanned_by(named({"rotation"})) &&
                     space_relative.along_spanned_by(named({"rotation about z"})));
}

LedgerEntry run_text_chapter_4(const ExperimentSettings& settings) {
  return entry_of(text_chapter_4, settings,
                  {method_claims(), partial_or_not(), third_step(), exteroceptive_only(), cv_velocities(),
                   accelerations(), lower_limit(), becomes_observable()});
}

}  // namespace
}  // namespace incognita::observability_claims

const incognita::Experiment incognita::text_chapter_4{
    "text-4", "Claims in the text of Chapter 4", {}, observability_claims::run_text_chapter_4};
