// Figures 5.12 to 5.14: one run, that of the first seed, and means over runs.
#include <cmath>
#include <numbers>

#include "experiments/curves.hpp"
#include "experiments/example_5_4.hpp"

namespace incognita::swinging_camera {
namespace {

using Eigen::Vector3d;

constexpr double pi = std::numbers::pi;
constexpr double degrees = 180 / pi;

Curve curve(const std::string& label, Style style, Color color) { return {label, style, {}, {}, {}, color}; }

void add(Curve& c, double x, double y) { c.x.push_back(x), c.y.push_back(y); }

/// f over the instants of a course.
template <class F>
Curve over_time(const std::string& label, const Course& course, Color color, const F& f,
                Style style = Style::line) {
  return curve_of(label, style, color, course.instants, &Instant::t, f);
}

// Figure 5.12 -----------------------------------------------------------------------------------------

Curve reference(const std::string& label, double from_s, double to_s, Style style, Color color) {
  Curve c = curve(label, style, color);
  for (double t = from_s; t <= to_s; t += 0.02) {
    const Vector3d p = at(Path(BackAndForthPath{}), t).position;
    add(c, p.x(), p.y());
  }
  return c;
}

Plot wanted_path() {
  Panel above{"(a) from above", "x, m", "y, m", {}, true};
  Curve start = curve("start", Style::circles, Color::orange), center = curve("", Style::crosses, Color::ink);
  add(start, -1.5, 0), add(center, 0, 0);
  above.curves = {reference("all around, 12 pi s", 0, 12 * pi, Style::dashed, Color::gray),
                  reference("the first 2 pi s", 0, 2 * pi, Style::line, Color::blue), start, center};
  above.x_range = above.y_range = {-2.2, 2.2};
  Panel angle{"(b) angle on the circle", "t, s", "degrees", {}};
  Curve p = curve("p", Style::line, Color::blue), mean = curve("-2 w k/pi", Style::dashed, Color::gray);
  for (double t = 0; t <= 12 * pi; t += 0.05) {
    add(p, t, -degrees * at(Path(BackAndForthPath{}), t).heading);
    add(mean, t, -degrees * 2 * BackAndForthPath{}.amplitude_rad * t / pi);
  }
  angle.curves = {mean, p};
  return {"fig-5.12", "Back and forth around a circle of 1.5 m, (5.28)", 2, {above, angle}};
}

// Figure 5.13 -----------------------------------------------------------------------------------------

/// Seen along an axis: which coordinates are drawn to the right and up.
struct View {
  const char* title;
  int right, up;
  const char *right_label, *up_label;
};

Panel seen(const Course& course, const View& v) {
  Panel panel{v.title, v.right_label, v.up_label, {}, true};
  const auto path = [&](const char* label, Style style, Color color, const auto& position) {
    return path_of(label, style, color, course.instants, position, v.right, v.up);
  };
  std::vector<Eigen::Vector2d> means;
  std::vector<Eigen::Matrix2d> covariances;
  for (const MappedPoint& p : course.map) {
    means.emplace_back(p.estimated[v.right], p.estimated[v.up]);
    covariances.push_back(p.covariance({v.right, v.up}, {v.right, v.up}));
  }
  Curve outlines = ellipses("2σ", means, covariances);
  outlines.color = Color::sky;
  panel.curves = {
      outlines,
      path_of("points", Style::stars, Color::amber, course.place, std::identity{}, v.right, v.up),
      path_of("map", Style::crosses, Color::blue, means),
      path("true", Style::thin, Color::green, &Instant::truth),
      path("estimated", Style::line, Color::orange, &Instant::mean),
      path("desired", Style::dashed, Color::ink, [](const Instant& i) { return i.reference.position; })};
  return panel;
}

Panel commands(const Course& course, const char* title, const char* label, int first) {
  Panel panel{title, "t, s", label, {}};
  const Color colors[] = {Color::blue, Color::orange, Color::green};
  const char* names[] = {"x", "y", "z"};
  for (int k = 0; k < 3; ++k)
    panel.curves.push_back(over_time(
        names[k], course, colors[k], [&](const Instant& i) { return i.command[first + k]; }, Style::thin));
  return panel;
}

Plot loop(const Course& course) {
  Panel tracking{"(c) desired less estimated position", "t, s", "m", {}},
      off{"(c) distance from the path", "t, s", "m", {}};
  const Color colors[] = {Color::blue, Color::orange, Color::green};
  const char* names[] = {"x", "y", "z"};
  for (int k = 0; k < 3; ++k)
    tracking.curves.push_back(over_time(
        names[k], course, colors[k], [&](const Instant& i) { return i.reference.position[k] - i.mean[k]; },
        Style::thin));
  off.curves = {
      over_time("true", course, Color::green, [](const Instant& i) { return i.truly_off_m(); }),
      over_time("estimated", course, Color::orange, [](const Instant& i) { return i.estimated_off_m(); })};
  Panel above = seen(course, {"(a) from above", 0, 1, "x, m", "y, m"}),
        aside = seen(course, {"(a) from the side", 0, 2, "x, m", "z, m"});
  above.x_range = aside.x_range = {-4.3, 4.3};
  above.y_range = {-3.3, 3.3}, aside.y_range = {-3.3, 3.3};
  return {"fig-5.13",
          "A single camera follows its path while it maps the room",
          2,
          {above, aside, commands(course, "(b) linear acceleration", "m/s^2", 0),
           commands(course, "(b) angular acceleration, camera axes", "rad/s^2", 3), tracking, off}};
}

// Figure 5.14 -----------------------------------------------------------------------------------------

Panel within_sigma(const Course& course, const char* title, const char* label, int k, double unit) {
  Panel panel{title, "t, s", label, {}};
  Curve band = over_time(
      "2σ", course, Color::sky, [&](const Instant& i) { return -2 * unit * i.sigma[k]; }, Style::band);
  for (const Instant& i : course.instants) band.y2.push_back(2 * unit * i.sigma[k]);
  panel.curves = {
      band, over_time("error", course, Color::orange, [&](const Instant& i) { return unit * i.error[k]; })};
  return panel;
}

Plot errors(const std::string& id, const std::string& title, const Course& course) {
  return {id,
          title,
          3,
          {within_sigma(course, "x", "m", 0, 1), within_sigma(course, "y", "m", 1, 1),
           within_sigma(course, "z", "m", 2, 1), within_sigma(course, "pitch", "degrees", 3, degrees),
           within_sigma(course, "yaw", "degrees", 4, degrees),
           within_sigma(course, "roll", "degrees", 5, degrees)}};
}

// Beside them -----------------------------------------------------------------------------------------

/// Over runs, each second.
Curve over_runs(const std::string& label, const std::vector<Summary>& runs,
                std::vector<double> Summary::*what, Color color) {
  Curve c = curve(label, Style::line, color);
  for (std::size_t k = 0; k < (runs.front().*what).size(); ++k) {
    double squares = 0;
    for (const Summary& s : runs) squares += (s.*what)[k] * (s.*what)[k];
    add(c, static_cast<double>(k), std::sqrt(squares / static_cast<double>(runs.size())));
  }
  return c;
}

Plot paths(const Compared& c) {
  Panel sigma{"(a) sigma of the position", "t, s", "m", {}},
      error{"(b) error of the position", "t, s", "m", {}};
  const auto both = [&](const char* name, const std::vector<Summary>& runs, Color color) {
    sigma.curves.push_back(over_runs(name, runs, &Summary::sigma_m, color));
    error.curves.push_back(over_runs(name, runs, &Summary::error_m, color));
  };
  both("back and forth", c.example, Color::blue);
  both("never back", c.surges, Color::orange);
  both("steady", c.steady, Color::pink);
  both("in place", c.swings, Color::green);
  return {"fig-5.14-paths", "Around the same circle, rms over runs", 2, {sigma, error}};
}

Plot laws() {
  Panel above{"(a) a camera with known state, from above", "x, m", "y, m", {}, true},
      gaze{"(b) gaze, disturbed", "t, s", "degrees off", {}};
  const auto way = [&](const char* name, Law law, Color color) {
    Setup s;
    s.law = law;
    Curve c = curve(name, Style::line, color);
    for (const auto& x : steered(s, 0, 1)) add(c, x[0], x[1]);
    above.curves.push_back(c);
  };
  const auto drift = [&](const char* name, Law law, Color color) {
    Setup s;
    s.law = law;
    Curve c = curve(name, Style::line, color);
    const auto states = steered(s, s.sigma_angular_acceleration_rad_s2, 1);
    for (std::size_t k = 0; k < states.size(); ++k) {
      const double t = static_cast<double>(k) / s.rate_hz;
      add(c, t, degrees * gaze_off_rad(states[k], at(s.path, t)));
    }
    gaze.curves.push_back(c);
  };
  way("v - y*, printed", Law::as_printed, Color::orange);
  way("v - v*", Law::velocity_mended, Color::pink);
  way("and a*", Law::corrected, Color::blue);
  above.curves.push_back(reference("desired", 0, 12 * pi, Style::dashed, Color::ink));
  above.x_range = above.y_range = {-3.4, 3.4};
  drift("rates alone, printed", Law::rate_alone, Color::orange);
  drift("with the orientation", Law::corrected, Color::blue);
  return {"fig-5.13-laws", "(5.29) as printed and corrected", 2, {above, gaze}};
}

}  // namespace

std::vector<Plot> figures(const Compared& compared) {
  const Course course = run({}, 1);
  Setup anchored;
  anchored.anchors = 6;
  return {wanted_path(),
          loop(course),
          laws(),
          errors("fig-5.14", "Errors of the estimate, no anchors", course),
          errors("fig-5.14-anchors", "Errors of the estimate, six anchors", run(anchored, 1)),
          paths(compared)};
}

}  // namespace incognita::swinging_camera
