// Figures 5.12 to 5.14: one run, that of the first seed, and means over runs.
#include <cmath>
#include <numbers>

#include "experiments/curves.hpp"
#include "experiments/example_5_4.hpp"
#include "incognita/math/angles.hpp"

namespace incognita::swinging_camera {
namespace {

using Eigen::Vector3d;

constexpr double pi = std::numbers::pi;

/// f over the instants of a course.
template <class F>
Curve over_time(const std::string& label, const Course& course, Color color, const F& f,
                Style style = Style::line) {
  return curve_of(label, style, color, course.instants, &Instant::t, f);
}

std::vector<double> times(double until_s, double step_s) {
  std::vector<double> all;
  for (double t = 0; t <= until_s; t += step_s) all.push_back(t);
  return all;
}

Curve reference(const std::string& label, double until_s, Style style, Color color) {
  return path_of(label, style, color, times(until_s, 0.02),
                 [](double t) { return at(Path(circle), t).position; });
}

Plot wanted_path() {
  const std::vector<double> round = times(12 * pi, 0.05);
  const auto angle = [](double t) { return -degrees(1) * at(Path(circle), t).heading; };
  const auto mean = [](double t) { return -degrees(1) * 2 * circle.amplitude_rad * t / pi; };
  Panel above{"(a) from above", "x, m", "y, m", {}, true};
  above.curves = {reference("all around, 12 pi s", 12 * pi, Style::dashed, Color::gray),
                  reference("the first 2 pi s", 2 * pi, Style::line, Color::blue),
                  {"start", Style::circles, {-1.5}, {0}, {}, Color::orange},
                  {"", Style::crosses, {0}, {0}, {}, Color::ink}};
  above.x_range = above.y_range = {-2.2, 2.2};
  return {"fig-5.12",
          "Back and forth around a circle of 1.5 m, (5.28)",
          2,
          {above, time_panel("(b) angle on the circle", "degrees",
                             {curve_of("-2 w k/pi", Style::dashed, Color::gray, round, std::identity{}, mean),
                              curve_of("p", Style::line, Color::blue, round, std::identity{}, angle)})}};
}

/// Seen along an axis: which coordinates are drawn to the right and up.
struct View {
  const char* title;
  int right, up;
  const char *right_label, *up_label;
};

Panel seen(const Course& course, const View& v) {
  const auto path = [&](const char* label, Style style, Color color, const auto& position) {
    return path_of(label, style, color, course.instants, position, v.right, v.up);
  };
  Panel panel{v.title, v.right_label, v.up_label, {}, true};
  panel.curves = {
      outlines_of("2σ", Color::sky, course.map, &MappedPoint::estimated, &MappedPoint::covariance, v.right,
                  v.up),
      path_of("points", Style::stars, Color::amber, course.place, std::identity{}, v.right, v.up),
      path_of("map", Style::crosses, Color::blue, course.map, &MappedPoint::estimated, v.right, v.up),
      path("true", Style::thin, Color::green, &Instant::truth),
      path("estimated", Style::line, Color::orange, &Instant::mean),
      path("desired", Style::dashed, Color::ink, [](const Instant& i) { return i.reference.position; })};
  panel.x_range = {-4.3, 4.3}, panel.y_range = {-3.3, 3.3};
  return panel;
}

/// of(instant, axis) of the three axes.
template <class Of>
Panel by_axis(const Course& course, const char* title, const char* label, const Of& of) {
  Panel panel = time_panel(title, label);
  const Color colors[] = {Color::blue, Color::orange, Color::green};
  const char* names[] = {"x", "y", "z"};
  for (int k = 0; k < 3; ++k)
    panel.curves.push_back(over_time(
        names[k], course, colors[k], [&](const Instant& i) { return of(i, k); }, Style::thin));
  return panel;
}

Plot loop(const Course& course) {
  return {"fig-5.13",
          "A single camera follows its path while it maps the room",
          2,
          {seen(course, {"(a) from above", 0, 1, "x, m", "y, m"}),
           seen(course, {"(a) from the side", 0, 2, "x, m", "z, m"}),
           by_axis(course, "(b) linear acceleration", "m/s^2",
                   [](const Instant& i, int k) { return i.command[k]; }),
           by_axis(course, "(b) angular acceleration, camera axes", "rad/s^2",
                   [](const Instant& i, int k) { return i.command[3 + k]; }),
           by_axis(course, "(c) desired less estimated position", "m",
                   [](const Instant& i, int k) { return i.reference.position[k] - i.mean[k]; }),
           time_panel("(c) distance from the path", "m",
                      {over_time("true", course, Color::green, &Instant::truly_off_m),
                       over_time("estimated", course, Color::orange, &Instant::estimated_off_m)})}};
}

Plot errors(const std::string& id, const std::string& title, const Course& course) {
  Plot plot{id, title, 3, {}};
  const char* names[] = {"x", "y", "z", "pitch", "yaw", "roll"};
  for (int k = 0; k < 6; ++k) {
    const double unit = k < 3 ? 1 : degrees(1);
    plot.panels.push_back(time_panel(
        names[k], k < 3 ? "m" : "degrees",
        {band_of("2σ", Color::sky, course.instants, &Instant::t,
                 [&](const Instant& i) { return -2 * unit * i.sigma[k]; }),
         over_time("error", course, Color::orange, [&](const Instant& i) { return unit * i.error[k]; })}));
  }
  return plot;
}

/// Rms over runs, each second.
Curve over_runs(const std::string& label, const std::vector<Summary>& runs,
                std::vector<double> Summary::*what, Color color) {
  Curve c{label, Style::line, {}, {}, {}, color};
  for (std::size_t k = 0; k < (runs.front().*what).size(); ++k) {
    c.x.push_back(static_cast<double>(k));
    c.y.push_back(rms_of(each(runs, [&](const Summary& s) { return (s.*what)[k]; })).value);
  }
  return c;
}

Plot paths(const Compared& c) {
  const auto panel = [&](const char* title, std::vector<double> Summary::*what) -> Panel {
    return time_panel(title, "m",
                      {over_runs("back and forth", c.example, what, Color::blue),
                       over_runs("never back", c.surges, what, Color::orange),
                       over_runs("steady", c.steady, what, Color::pink),
                       over_runs("in place", c.swings, what, Color::green)});
  };
  return {"fig-5.14-paths",
          "Around the same circle, rms over runs",
          2,
          {panel("(a) sigma of the position", &Summary::sigma_m),
           panel("(b) error of the position", &Summary::error_m)}};
}

Plot laws() {
  const auto way = [&](const char* name, Law law, Color color) {
    return path_of(name, Style::line, color, steered({.law = law}, 0, 1));
  };
  const auto drift = [&](const char* name, Law law, Color color) {
    const Setup s{.law = law};
    Curve c{name, Style::line, {}, {}, {}, color};
    for (const auto& state : steered(s, s.sigma_angular_acceleration_rad_s2, 1)) {
      c.x.push_back(static_cast<double>(c.x.size()) / s.rate_hz);
      c.y.push_back(degrees(1) * gaze_off_rad(state, at(s.path, c.x.back())));
    }
    return c;
  };
  Panel above{"(a) a camera with known state, from above", "x, m", "y, m", {}, true};
  above.curves = {way("v - y*, printed", Law::as_printed, Color::orange),
                  way("v - v*", Law::velocity_mended, Color::pink),
                  way("and a*", Law::corrected, Color::blue),
                  reference("desired", 12 * pi, Style::dashed, Color::ink)};
  above.x_range = above.y_range = {-3.4, 3.4};
  return {"fig-5.13-laws",
          "(5.29) as printed and corrected",
          2,
          {above, time_panel("(b) gaze, disturbed", "degrees off",
                             {drift("rates alone, printed", Law::rate_alone, Color::orange),
                              drift("with the orientation", Law::corrected, Color::blue)})}};
}

}  // namespace

std::vector<Plot> figures(const Compared& compared) {
  const Course course = run({}, 1);
  return {wanted_path(),
          loop(course),
          laws(),
          errors("fig-5.14", "Errors of the estimate, no anchors", course),
          errors("fig-5.14-anchors", "Errors of the estimate, six anchors", run({.anchors = 6}, 1)),
          paths(compared)};
}

}  // namespace incognita::swinging_camera
