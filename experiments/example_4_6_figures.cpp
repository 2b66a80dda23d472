// Figures 4.3 to 4.6, by the filter of Example 4.6, compared with the printed ones.
#include <limits>

#include "experiments/curves.hpp"
#include "experiments/example_4_6.hpp"

namespace incognita::two_bearings {
namespace {

constexpr double gap = std::numeric_limits<double>::quiet_NaN();

Plot map() {
  const Run& u = usual();
  const auto position = [](const Instant& i) { return i.pose; };  // drawn with north up
  std::vector<Instant> stops;
  for (const double t : {0.0, 10.0, 14.0, 20.0}) stops.push_back(u.drive[u.measurement_at(t)]);
  const auto& [first, second] = u.setup.features;
  Panel p{"", "east y, m", "north x, m", {}, true};
  p.x_range = {-4, 16};
  p.y_range = {-1, 17};
  p.curves = {path_of("vehicle", Style::line, Color::blue, u.drive, position, 1, 0),
              path_of("after 0, 10, 14, 20 s", Style::circles, Color::blue, stops, position, 1, 0),
              {"feature 1", Style::stars, {first.y()}, {first.x()}, {}, Color::orange},
              {"feature 2", Style::stars, {second.y()}, {second.x()}, {}, Color::green}};
  return {"fig-4.3", "Trajectory and features", 1, {p}};
}

Curve over_time(const std::string& label, const Run& run, const std::vector<double>& values, Color color,
                Style style = Style::line) {
  Curve curve{label, style, {}, values, {}, color};
  for (const Instant& i : run.drive) curve.x.push_back(i.t_s);
  return curve;
}

Curve over_time(const std::string& label, const Run& run, const Direction& c, Color color,
                Style style = Style::line) {
  return over_time(label, run, information(run, c), color, style);
}

/// Every n-th measurement of the usual drive.
Curve rank_curve(const std::string& label, const std::vector<Knowledge>& known, Style style, Color color,
                 std::size_t every = 1) {
  Curve curve{label, style, {}, {}, {}, color};
  for (std::size_t k = 0; k < known.size(); k += every) {
    curve.x.push_back(usual().drive[k].t_s);
    curve.y.push_back(known[k].rank.rank);
  }
  return curve;
}

Plot ranks_over_time() {
  const Run& u = usual();
  Panel ranks{"", "time, s", "rank", {}};
  ranks.y_range = {0, 7};
  ranks.curves = {{"printed", Style::dashed, {0, 10, 10, 14, 14, 20}, {2, 2, 4, 4, 5, 5}, {}, Color::gray},
                  rank_curve("information matrix", u.known, Style::steps, Color::blue),
                  rank_curve("along the motion", along_the_motion(u.setup), Style::crosses, Color::blue, 10),
                  rank_curve("stripped (4.8)", stripped(u.setup), Style::circles, Color::orange, 10)};
  Panel values{"Singular values of the root of the information matrix, meters in units of 10",
               "time, s",
               "of the largest",
               {}};
  values.log_y = true;
  values.y_range = {1e-17, 10};
  for (int i = 0; i < states; ++i) {
    std::vector<double> kept(u.known.size(), gap), left = kept;
    for (std::size_t k = 0; k < u.known.size(); ++k) {
      const Rank& r = u.known[k].rank;
      (i < r.rank ? kept : left)[k] = r.singular_values[i] / r.singular_values[0];
    }
    values.curves.push_back(over_time(i == 0 ? "counted" : "", u, kept, Color::blue));
    values.curves.push_back(over_time(i == 0 ? "left out" : "", u, left, Color::gray, Style::points));
  }
  values.curves.push_back(
      {"tolerance", Style::dashed, {0, end_s}, {rank_tolerance, rank_tolerance}, {}, Color::ink});
  return {"fig-4.4", "Rank of the information matrix and of two observability matrices", 1, {ranks, values}};
}

Plot orientation_over_time() {
  const Direction c = state(heading);
  const Run late(Setup{.jacobians = Jacobians::odometry_late}),
      strays(Setup{.jacobians = Jacobians::estimates});
  Panel p{"", "time, s", "information, 1/rad^2", {}};
  p.y_range = {-0.05, 1.25};
  p.curves = {over_time("at the truth", usual(), c, Color::blue),
              over_time("odometry a step late", late, c, Color::orange, Style::dashed),
              over_time("at estimates 1 cm off", strays, c, Color::gray)};
  return {"fig-4.5", "Marginal information of the heading, by where Jacobians are taken", 1, {p}};
}

/// Three panels: Figure 4.6 (a), (b), (c).
std::vector<Panel> modes_of(const Run& run, const std::string& whose) {
  const auto panel = [&](const std::string& letter, const std::string& x_name, const Direction& x_mode,
                         const std::string& y_name, const Direction& y_mode) {
    Panel p{letter + " " + whose, "time, s", "information, 1/m^2", {}};
    p.curves = {over_time(x_name, run, x_mode, Color::blue),
                over_time(y_name, run, y_mode, Color::orange, Style::dashed)};
    return p;
  };
  std::vector<Panel> panels{
      panel("(a)", "x_r + x_f1 + x_f2", sum({x, x1, x2}), "y_r + y_f1 + y_f2", sum({y, y1, y2})),
      panel("(b)", "x_r - x_f1", difference(x, x1), "y_r - y_f1", difference(y, y1)),
      panel("(c)", "x_f1 - x_f2", difference(x1, x2), "y_f1 - y_f2", difference(y1, y2))};
  panels[0].y_range = {-0.05, 1};
  return panels;
}

Plot modes_over_time() {
  const Run a_step_late(Setup{.jacobians = Jacobians::odometry_late});
  std::vector<Panel> truth = modes_of(usual(), "Jacobians at the truth"),
                     late = modes_of(a_step_late, "odometry a step late");
  truth[1].curves.push_back(over_time("distance", usual(), distance(x, x1), Color::green));
  truth[2].curves.push_back(over_time("distance", usual(), distance(x1, x2), Color::green));
  return {"fig-4.6",
          "Marginal information of modes",
          2,
          {truth[0], late[0], truth[1], late[1], truth[2], late[2]}};
}

}  // namespace

std::vector<Plot> figures() { return {map(), ranks_over_time(), orientation_over_time(), modes_over_time()}; }

}  // namespace incognita::two_bearings
