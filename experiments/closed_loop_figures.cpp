#include "experiments/closed_loop_figures.hpp"

#include <fmt/format.h>

#include <cmath>

#include "experiments/closed_loop_statistics.hpp"
#include "experiments/curves.hpp"
#include "incognita/math/angles.hpp"
#include "incognita/math/unknown.hpp"

namespace incognita::closed_loop {
namespace {

constexpr Color colors[] = {Color::blue, Color::orange, Color::green, Color::pink};
template <class Of>
Curve over_time(const std::string& label, const Run& run, std::size_t robot, Color color, const Of& of) {
  return curve_of(label, Style::line, color, run.instants, &Instant::t_s,
                  [&](const Instant& i) { return of(i.robots[robot]); });
}

Panel panel_over_time(const std::string& title, const std::string& y_label, std::vector<Curve> curves,
                      std::optional<std::pair<double, double>> y_range = {}) {
  return {.title = title,
          .x_label = "time, s",
          .y_label = y_label,
          .curves = std::move(curves),
          .y_range = y_range};
}

/// A heading jumps from one end of its range to the other: a gap there instead of a line.
Curve with_gaps(Curve curve) {
  for (std::size_t i = 1; i < curve.y.size(); ++i)
    if (std::abs(curve.y[i] - curve.y[i - 1]) > 180) curve.y[i - 1] = unknown;
  return curve;
}

Panel error_panel(const std::string& title, const Run& run, std::size_t robot, int state) {
  const double unit = state == 2 ? degrees(1) : 1;
  static constexpr const char* labels[] = {"error of x, m", "error of y, m", "error of heading, deg"};
  const auto two_sigmas = [&](const Instant& i) {
    return 2 * unit * std::sqrt(i.robots[robot].covariance(state, state));
  };
  return panel_over_time(title, labels[state],
                         {band_of("2 sigma", Color::gray, run.instants, &Instant::t_s, two_sigmas),
                          over_time("truth less estimate", run, robot, Color::blue,
                                    [&](const RobotInstant& r) { return unit * r.error()[state]; })});
}

Panel position_panel(const std::string& title, const Run& run, std::size_t robot) {
  return panel_over_time(
      title, "estimate, m",
      {over_time("x", run, robot, Color::blue, [](const RobotInstant& r) { return r.mean.x(); }),
       over_time("y", run, robot, Color::orange, [](const RobotInstant& r) { return r.mean.y(); })});
}

Panel heading_panel(const std::string& title, const Run& run, std::size_t robot) {
  const Curve heading = over_time("heading", run, robot, Color::green,
                                  [](const RobotInstant& r) { return degrees(r.mean[2]); });
  return panel_over_time(title, "estimate, deg", {with_gaps(heading)}, {{-185, 185}});
}

Panel command_panel(const std::string& title, const Run& run, std::size_t robot) {
  return panel_over_time(
      title, "command",
      {over_time("turn rate, rad/s", run, robot, Color::orange,
                 [](const RobotInstant& r) { return r.input[1]; }),
       over_time("speed, m/s", run, robot, Color::blue, [](const RobotInstant& r) { return r.input[0]; })},
      {{-1.15, 1.15}});
}

Curve poses_of(const std::string& label, const Run& run, std::size_t robot,
               planar::Pose<double> RobotInstant::*pose, Style style, Color color) {
  return path_of(label, style, color, run.instants, [&](const Instant& i) { return i.robots[robot].*pose; });
}

Curve wanted(const std::string& label, const Path& path, const Run& run) {
  const auto position = [&](const Instant& i) { return at(path, i.t_s).position; };
  if (std::holds_alternative<PointPath>(path))
    return path_of(label, Style::crosses, Color::ink, run.instants, position);
  return path_of(label, Style::dashed, Color::gray, run.instants, position);
}

/// Every ten seconds.
Curve robot_ellipses(const Run& run, std::size_t robot) {
  std::vector<RobotInstant> instants;
  for (std::size_t k = 0; k < run.instants.size(); k += 100)
    instants.push_back(run.instants[k].robots[robot]);
  return outlines_of("", colors[robot], instants, &RobotInstant::mean, &RobotInstant::covariance);
}

}  // namespace

Plot map_figure(const std::string& id, const std::string& title, const Setup& setup, const Run& run) {
  Panel panel{"", "x, m", "y, m", {}, true};
  for (std::size_t i = 0; i < setup.robots.size(); ++i) {
    const bool one = setup.robots.size() == 1;
    const std::string who = one ? "" : fmt::format(" {}", i + 1);
    const Path& path = setup.robots[i].steering.path;
    const std::string goal = std::holds_alternative<PointPath>(path) ? "goal" : "path";
    const planar::Pose<double>& start = run.instants.front().robots[i].truth;
    panel.curves.push_back(wanted(i == 0 ? goal : "", path, run));
    panel.curves.push_back(poses_of("robot" + who, run, i, &RobotInstant::truth, Style::line, colors[i]));
    panel.curves.push_back(
        poses_of(i == 0 ? "estimate" : "", run, i, &RobotInstant::mean, Style::thin, Color::ink));
    panel.curves.push_back(robot_ellipses(run, i));
    panel.curves.push_back({i == 0 ? "start" : "", Style::circles, {start.x()}, {start.y()}, {}, colors[i]});
  }
  panel.curves.push_back(
      path_of("landmarks", Style::stars, Color::gray, setup.place, &PointLandmarks::value_type::second));
  panel.curves.push_back(
      outlines_of("map, 2 sigma", Color::green, run.map, &MappedLandmark::mean, &MappedLandmark::covariance));
  return {id, title, 1, {panel}};
}

Plot state_figure(const std::string& id, const std::string& title, const Run& run) {
  const std::size_t robots = run.instants.front().robots.size();
  Plot plot{id, title, std::max(2, static_cast<int>(robots)), {}};
  const auto row = [&](const auto& panel_of) {
    const bool named = robots > 1 && plot.panels.empty();
    for (std::size_t i = 0; i < robots; ++i)
      plot.panels.push_back(panel_of(named ? fmt::format("robot {}", i + 1) : "", i));
  };
  row([&](const std::string& name, std::size_t i) { return position_panel(name, run, i); });
  row([&](const std::string& name, std::size_t i) { return heading_panel(name, run, i); });
  for (int state = 0; state < 3; ++state)
    row([&](const std::string& name, std::size_t i) { return error_panel(name, run, i, state); });
  row([&](const std::string& name, std::size_t i) { return command_panel(name, run, i); });
  return plot;
}

Plot eigenvalue_figure(const std::string& id, const std::string& title, const Run& run,
                       const std::function<Eigen::Matrix2d(const planar::Pose<double>&)>& gain) {
  const auto size = [&](const char* label, Color color, int k) {
    return over_time(label, run, 0, color, [&](const RobotInstant& r) { return moduli(r, gain(r.mean))[k]; });
  };
  const Curve one{"1", Style::dashed, {0, run.instants.back().t_s}, {1, 1}, {}, Color::gray};
  const Panel panel = panel_over_time("", "magnitude of the eigenvalues of F - G L",
                                      {one, size("third", Color::green, 2), size("second", Color::orange, 1),
                                       size("largest", Color::blue, 0)});
  return {id, title, 1, {panel}};
}

}  // namespace incognita::closed_loop
