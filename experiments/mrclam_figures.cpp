#include "experiments/mrclam.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "experiments/curves.hpp"
#include "experiments/seeds.hpp"

namespace incognita::recorded_team {
namespace {

Setup iterated(Setup setup) {
  setup.linearization = Linearization::iterated;
  return setup;
}

/// For each robot the least over the four.
template <class Get>
std::vector<double> best(const Alone& alone, const Get& of_drive) {
  std::vector<double> least(alone.plain.size(), std::numeric_limits<double>::infinity());
  for (const std::vector<Drive>* way : alone.all())
    for (std::size_t i = 0; i < way->size(); ++i) least[i] = std::min(least[i], of_drive((*way)[i]));
  return least;
}

/// By number of the robot.
Curve points(const std::string& label, Style style, Color color, const std::vector<double>& y) {
  Curve curve = over_steps(label, y, style, 1);
  curve.color = color;
  return curve;
}

/// Ticks that are drawn, 2 s apart: 16 points a second would not be distinguishable.
std::vector<std::size_t> drawn(const RobotCourse& robot) {
  std::vector<std::size_t> ticks;
  for (std::size_t k = 0; k < robot.t_s.size(); ++k)
    if (ticks.empty() || robot.t_s[k] >= robot.t_s[ticks.back()] + 2) ticks.push_back(k);
  return ticks;
}

Plot table(const Drives& d) {
  const auto panel = [&](const char* title, Number what) {
    Panel p{title, "robot", "rms position error, m", {}};
    p.curves = {points("joint", Style::circles, Color::blue, of_robots(d.joint, what)),
                points("shared map", Style::crosses, Color::green, of_robots(d.shared_map, what)),
                points("alone", Style::stars, Color::orange, of_robots(d.alone.plain, what)),
                points("alone, best of four", Style::stars, Color::gray, best_robots(d.alone, what))};
    p.log_y = true;
    p.y_range = {0.05, 2};
    p.x_range = {0.5, static_cast<double>(d.alone.plain.size()) + 0.5};
    return p;
  };
  return {"fig-mrclam-robots",
          "Five recorded robots against motion capture",
          2,
          {panel("(a) nothing fitted", &RobotCourse::rms_m),
           panel("(b) after a rigid fit of the landmarks", &RobotCourse::fitted_rms_m)}};
}

Plot landmark_table(const Drives& d) {
  Panel p{"", "landmark", "distance from the survey, m", {}};
  const auto curve = [&](const std::string& label, const Drive& drive, Style style, Color color) {
    return curve_of(label, style, color, drive.landmarks, &MappedLandmark::identity,
                    &MappedLandmark::fitted_off_m);
  };
  const Color colors[] = {Color::orange, Color::green, Color::pink, Color::amber, Color::sky};
  for (std::size_t i = 0; i < d.alone.plain.size(); ++i)
    p.curves.push_back(
        curve(fmt::format("robot {} alone", i + 1), d.alone.plain[i], Style::crosses, colors[i % 5]));
  p.curves.push_back(curve("joint", d.joint, Style::circles, Color::blue));
  p.log_y = true;
  p.x_range = {5.5, 20.5};
  return {"fig-mrclam-landmarks", "Landmarks after a rigid fit to the survey", 1, {p}};
}

Panel map_of(const char* title, const Drive& drive) {
  Panel panel{title, "x, m", "y, m", {}, true};
  panel.x_range = {-2.5, 8.5}, panel.y_range = {-5.5, 5.5};
  const RobotCourse& robot = drive.robots.front();
  const auto path = [&](const char* label, Color color, planar::Pose<double> PoseInstant::*pose) {
    return path_of(label, Style::thin, color, drawn(robot),
                   [&](std::size_t k) { return robot.instants[k].*pose; });
  };
  const auto& landmarks = drive.landmarks;
  panel.curves = {
      path("motion capture", Color::gray, &PoseInstant::truth),
      path("estimated", Color::orange, &PoseInstant::mean),
      outlines_of("2σ", Color::sky, landmarks, &MappedLandmark::estimated, &MappedLandmark::covariance),
      path_of("surveyed", Style::circles, Color::ink, landmarks, &MappedLandmark::surveyed),
      path_of("landmarks", Style::crosses, Color::blue, landmarks, &MappedLandmark::estimated)};
  return panel;
}

Plot maps(const Drives& d) {
  return {"fig-mrclam-map",
          "Robot 1 and its landmarks, nothing fitted",
          2,
          {map_of("(a) with the others, joint", d.joint), map_of("(b) alone", d.alone.plain.front())}};
}

Plot errors(const Drives& d) {
  Plot plot{"fig-mrclam-errors", "Distance from motion capture", 2, {}};
  for (std::size_t i = 0; i < d.alone.plain.size(); ++i) {
    const auto curve = [](const char* name, const RobotCourse& robot, Color color) {
      return curve_of(
          name, Style::thin, color, drawn(robot), [&](std::size_t k) { return robot.t_s[k]; },
          [&](std::size_t k) { return robot.instants[k].error().head<2>().norm(); });
    };
    Panel panel = time_panel(fmt::format("robot {}", i + 1), "m");
    panel.curves = {curve("alone", d.alone.plain[i].robots.front(), Color::orange),
                    curve("joint", d.joint.robots[i], Color::blue)};
    panel.log_y = true;
    panel.y_range = {0.01, 10};
    plot.panels.push_back(panel);
  }
  return plot;
}

}  // namespace

Alone drive_alone(const Robots& robots, const Setup& setup) {
  return {each_alone(robots, setup), each_alone(robots, iterated(setup)),
          each_alone(robots, setup, Times::own), each_alone(robots, iterated(setup), Times::own)};
}

Drives compare(const Robots& robots) {
  return {together(robots, {}), together(robots, iterated({})), together(robots, {.see_each_other = false}),
          drive_alone(robots, {})};
}

std::vector<double> of_robots(const Drive& drive, Number what) { return each(drive.robots, what); }

std::vector<double> of_robots(const std::vector<Drive>& alone, Number what) {
  return each(alone, [&](const Drive& drive) { return drive.robots.front().*what; });
}

std::vector<double> best_robots(const Alone& alone, Number what) {
  return best(alone, [&](const Drive& drive) { return drive.robots.front().*what; });
}

std::vector<double> best_maps(const Alone& alone, double Drive::*what) {
  return best(alone, [&](const Drive& drive) { return drive.*what; });
}

std::vector<Plot> figures(const Drives& d) { return {table(d), maps(d), errors(d), landmark_table(d)}; }

}  // namespace incognita::recorded_team
