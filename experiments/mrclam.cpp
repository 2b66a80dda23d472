// Section 5.2.1 on real robots: five in one belief, (5.16)-(5.19), compared with the same filter for each
// alone. See recorded_team.hpp for the recording, its noises and its start.
//
// Measured at every time of a measurement by any robot: rms of each robot's position against motion capture,
// as it is and after the rigid fit of the estimated landmarks to the surveyed ones; each landmark's distance
// from its survey; NEES of the poses, NIS. A robot alone is given the best of four: plain and iterated,
// evaluated at the team's times and at its own. Holds: joint better than that for each of the five, with the
// noises as fixed, halved and doubled.
#include "experiments/mrclam.hpp"
#include "experiments/common.hpp"

namespace incognita::recorded_team {
namespace {

std::string list(const std::vector<double>& values, const char* unit = " m", int digits = 2) {
  std::string text;
  for (const double v : values) text += fmt::format("{}{:.{}f}", text.empty() ? "" : ", ", v, digits);
  return text + unit;
}

bool smaller(const std::vector<double>& a, const std::vector<double>& b) {
  return std::ranges::max(log_ratios(a, b)) < 0;
}

/// By how much a is larger than b at the least.
double least_ratio(const std::vector<double>& a, const std::vector<double>& b) {
  return std::exp(std::ranges::min(log_ratios(a, b)));
}

/// `0.11 to 0.13 m`
std::string range(const std::vector<double>& values, const char* unit = " m", int digits = 2) {
  return fmt::format("{:.{}f} to {:.{}f}{}", std::ranges::min(values), digits, std::ranges::max(values),
                     digits, unit);
}

Claim joint_beats_alone(const Drives& d) {
  const auto joint = of_robots(d.joint, &RobotCourse::rms_m),
             fitted = of_robots(d.joint, &RobotCourse::fitted_rms_m),
             alone = best_robots(d.alone, &RobotCourse::rms_m),
             alone_fitted = best_robots(d.alone, &RobotCourse::fitted_rms_m);
  return assessed(
      "mrclam-joint", "Section 5.2.1, (5.16)-(5.19)",
      "The extension to many robots is direct, and improves the estimate: where they measure "
      "each other every robot's rms position error is smaller in one belief than alone, nothing "
      "fitted and after a rigid fit of the landmarks",
      {.rule = Rule::superiority,
       .measured = {"five robots, {:.0f} s, by robot, alone the best of four filters. Nothing "
                    "fitted: joint {}; alone {}. After the fit: joint {}; alone {}. Headings: "
                    "joint {}; alone {}",
                    d.joint.recorded_s, list(joint), list(alone), list(fitted), list(alone_fitted),
                    range(of_robots(d.joint, &RobotCourse::rms_heading_rad), " rad"),
                    range(of_robots(d.alone.plain, &RobotCourse::rms_heading_rad), " rad")},
       .number = exactly("error alone over that in one belief, the least of five robots",
                         least_ratio(alone, joint))},
      smaller(joint, alone) && smaller(fitted, alone_fitted));
}

Claim seeing_each_other(const Drives& d) {
  const auto joint = of_robots(d.joint, &RobotCourse::rms_m),
             shared = of_robots(d.shared_map, &RobotCourse::rms_m),
             alone = best_robots(d.alone, &RobotCourse::rms_m);
  return assessed(
      "mrclam-each-other", "(5.17)",
      "Measurements of each other help beyond the map that they share: every robot's rms error is smaller "
      "with them than without, in the same joint filter",
      {.rule = Rule::superiority,
       .measured = {"with {}; without, the map shared, {}; alone {}. {} measurements, {} of them of robots",
                    list(joint), list(shared), list(alone), d.joint.measurements,
                    d.joint.measurements - d.shared_map.measurements},
       .number = exactly("error without these measurements over that with them, the least of five robots",
                         least_ratio(shared, joint))},
      smaller(joint, shared));
}

Claim landmarks(const Robots& robots, const Drives& d) {
  const auto alone = best_maps(d.alone, &Drive::map_rms_m),
             alone_fitted = best_maps(d.alone, &Drive::fitted_map_rms_m);
  const auto better_than = [](double joint, const std::vector<double>& all) {
    return joint < *std::ranges::min_element(all);
  };
  const auto off = each(d.joint.landmarks, &MappedLandmark::fitted_off_m);
  const bool all_there = d.joint.landmarks.size() == robots.front().landmarks.size();
  return assessed(
      "mrclam-landmarks", "Section 5.2.1",
      "The joint map has every landmark and is better than that of any robot alone, nothing fitted and after "
      "a rigid fit (rms over landmarks)",
      {.rule = Rule::superiority,
       .measured = {"nothing fitted: joint {:.3f} m; alone {}. After the fit, a turn by {:.1f} degrees: "
                    "joint {:.3f} m; alone {}. Landmarks after the fit: {}",
                    d.joint.map_rms_m, list(alone, " m", 3), degrees(d.joint.fit.turn_rad),
                    d.joint.fitted_map_rms_m, list(alone_fitted, " m", 3), range(off)},
       .number = exactly("error of the best map alone over that of the joint map, after a fit",
                         std::ranges::min(alone_fitted) / d.joint.fitted_map_rms_m),
       .why = "if nothing is fitted. After the fit some robots have the landmarks' distances more accurately "
              "by themselves"},
      all_there && better_than(d.joint.map_rms_m, alone) &&
          better_than(d.joint.fitted_map_rms_m, alone_fitted),
      on_condition(all_there && better_than(d.joint.map_rms_m, alone)));
}

/// The largest factor, either way, between two lists.
double largest_factor(const std::vector<double>& a, const std::vector<double>& b) {
  double most = 0;
  for (const double logarithm : log_ratios(b, a)) most = std::max(most, std::abs(logarithm));
  return std::exp(most);
}

Claim linearized_once(const Drives& d) {
  const auto alone = of_robots(d.alone.plain, &RobotCourse::rms_m),
             alone_iterated = of_robots(d.alone.iterated, &RobotCourse::rms_m);
  const double joint = largest_factor(of_robots(d.joint, &RobotCourse::rms_m),
                                      of_robots(d.joint_iterated, &RobotCourse::rms_m));
  const double by_itself = largest_factor(alone, alone_iterated);
  const auto blind = each(d.alone.plain, &Drive::longest_blind_s);
  const auto heading =
      each(d.alone.plain, [](const Drive& drive) { return degrees(drive.robots[0].most_sigma_heading_rad); });
  return assessed(
      "mrclam-linearised", "(5.18), (5.19)",
      "First-order linearization is enough: iterating the update changes no robot's rms error by more than a "
      "tenth",
      {.rule = Rule::equality,
       .measured = {"joint: by a factor of {:.2f} at most; alone: plain {}, iterated {}. Longest time "
                    "without a measurement: joint {:.1f} s, alone {}; largest sigma of the heading: alone {}",
                    joint, list(alone), list(alone_iterated), d.joint.longest_blind_s, range(blind, " s", 0),
                    range(heading, " degrees", 0)},
       .number = exactly("change by iterating, robots alone, at most", by_itself, "times"),
       .why = "in the joint filter, in which no robot is long without a measurement. A robot alone is, and "
              "its heading becomes unsure to tens of degrees meanwhile"},
      joint < 1.1 && by_itself < 1.1,
      on_condition(joint < 1.1 && d.joint.longest_blind_s < std::ranges::min(blind) &&
                   std::ranges::min(heading) > 10));
}

Claim consistent(const Robots& robots, const Drives& d) {
  const Drive wide = together(robots, {.input_sigmas_times = 2});
  const auto nees = of_robots(d.joint, &RobotCourse::nees);
  return assessed(
      "mrclam-consistent", "(5.18), (5.19)",
      "The error of the estimate is that of (5.19): NEES over its degrees of freedom within 0.2 of 1 for every "
      "robot",
      {.rule = Rule::equality,
       .measured = {"NEES by robot: joint {}, NIS {:.2f}; alone {}; joint with twice the noise on the "
                    "odometry {}, NIS {:.2f}",
                    list(nees, "", 1), d.joint.nis, list(of_robots(d.alone.plain, &RobotCourse::nees), "", 1),
                    list(of_robots(wide, &RobotCourse::nees), "", 1), wide.nis},
       .number = exactly("NEES of the joint filter, the worst robot", std::ranges::max(nees)),
       .why = "measurements agree with the prediction better than their noises say (NIS below 1), and the "
              "truth worse than the filter says: its errors are not those of white noise"},
      std::ranges::all_of(nees, [](double x) { return std::abs(x - 1) < nees_margin; }),
      in_truth(d.joint.nis < 1 && std::ranges::min(nees) > 1));
}

Claim sensitivity(const Robots& robots) {
  Cases cases;
  double least = std::numeric_limits<double>::infinity();
  using Variant = std::pair<const char*, Setup>;
  for (const auto& [name, setup] : {Variant("half the odometry's noise", {.input_sigmas_times = 0.5}),
                                    Variant("twice", {.input_sigmas_times = 2}),
                                    Variant("half the sensor's", {.sensor_sigmas_times = 0.5}),
                                    Variant("twice", {.sensor_sigmas_times = 2})}) {
    const auto joint = of_robots(together(robots, setup), &RobotCourse::rms_m),
               alone = best_robots(drive_alone(robots, setup), &RobotCourse::rms_m);
    cases.add({{"{}: joint {}, alone {}", name, range(joint), range(alone)}, smaller(joint, alone)});
    least = std::min(least, least_ratio(alone, joint));
  }
  return assessed("mrclam-noises", "Section 5.2.1",
                  "The result does not depend on the noises that the filter is given: with those of the "
                  "odometry or of the sensor halved or doubled, joint is still better for every robot",
                  {.rule = Rule::superiority,
                   .measured = cases.text(),
                   .number = exactly("error alone over that in one belief, the least of all", least)},
                  cases.hold());
}

Claim cost(const Drives& d) {
  const double times = d.joint.recorded_s / d.joint.took_s;
  return assessed(
      "mrclam-cost", "Section 5.2.1",
      "One belief of five robots and 15 landmarks is affordable: updated more than 20 times faster than it "
      "was recorded, on one processor",
      {.rule = Rule::superiority,
       .measured = times > 20 ? "more than 20 times" : fmt::format("{:.1f} times", times),
       .timed = true},
      times > 20);
}

LedgerEntry run(const ExperimentSettings& settings) {
  return unless_missing(mrclam, load, [&](const Robots& robots) {
    const Drives drives = compare(robots);
    return entry_of(mrclam, settings,
                    {joint_beats_alone(drives), seeing_each_other(drives), landmarks(robots, drives),
                     linearized_once(drives), consistent(robots, drives), sensitivity(robots), cost(drives)},
                    figures(drives));
  });
}

}  // namespace
}  // namespace incognita::recorded_team

namespace incognita {

const Experiment mrclam{"mrclam",
                        "Five recorded robots in one belief",
                        {"fig-mrclam-robots", "fig-mrclam-map", "fig-mrclam-errors", "fig-mrclam-landmarks"},
                        recorded_team::run};

}  // namespace incognita
