#include "incognita/report/figure_scripts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "incognita/analysis/evaluation/trajectory.hpp"
#include "incognita/messages/errors.hpp"
#include "incognita/record/files/csv_table.hpp"
#include "incognita/record/files/tum.hpp"
#include "incognita/report/figure_style.hpp"
#include "incognita/report/gnuplot.hpp"

namespace incognita {
namespace fs = std::filesystem;
namespace {

std::vector<double> finite(std::vector<double> values) {
  std::erase_if(values, [](double v) { return !std::isfinite(v); });
  return values;
}

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

/// `set xrange` for the times of a table, with a positive width even for a single frame.
std::string time_range(const CsvTable& table) {
  const auto t = finite(table.numbers("t"));
  if (t.empty()) return "";
  const auto [first, last] = std::minmax_element(t.begin(), t.end());
  return fmt::format("set xrange [{}:{}]\n", *first, std::max(*last, *first + 1e-3));
}

/// The rows of a TUM file; empty if the file is missing or contains no pose.
Trajectory poses_if_any(const fs::path& path) {
  if (!fs::exists(path)) return {};
  try {
    return read_trajectory(path);
  } catch (const InputError&) {
    return {};
  }
}

struct Box {
  double low[2] = {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  double high[2] = {-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  void include(double x, double y) {
    const double p[2] = {x, y};
    for (int i = 0; i < 2; ++i) {
      low[i] = std::min(low[i], p[i]);
      high[i] = std::max(high[i], p[i]);
    }
  }
  bool empty() const { return low[0] > high[0]; }
};

/// A path is interrupted at time steps longer than this, because no pose was known there.
double longest_step_s(const Trajectory& path) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < path.size(); ++i) steps.push_back(path[i].t - path[i - 1].t);
  return steps.empty() ? 1.0 : 5 * quantile(steps, 0.5);
}

/// The truth in frame and unit of the estimate; empty if the two cannot be aligned.
Trajectory truth_on_estimate(const Trajectory& truth, const Trajectory& estimate, AlignmentKind kind) {
  if (truth.empty() || kind == AlignmentKind::none) return truth;
  constexpr double same_frame_s = 1e-6;
  const auto a = align(match(estimate, truth, same_frame_s), kind);
  if (!a) return {};
  return aligned(truth, {1 / a->scale, a->rotation.transpose(),
                         -1 / a->scale * (a->rotation.transpose() * a->translation)});
}

/// Data block "$name << EOD" with x and y of each pose.
std::string path_block(const std::string& name, const Trajectory& path) {
  std::string block = fmt::format("${} << EOD\n", name);
  for (const StampedPose& pose : path) block += fmt::format("{},{}\n", pose.position.x(), pose.position.y());
  return block + "EOD\n";
}

std::string axis_label(const std::string& axis, AlignmentKind alignment) {
  return axis + (alignment == AlignmentKind::sim3 ? ", arbitrary units (scale unobservable)" : ", m");
}

std::vector<Eigen::Vector2d> surveyed_places(const fs::path& run_directory) {
  std::vector<Eigen::Vector2d> places;
  if (!fs::exists(run_directory / "surveyed.csv")) return places;
  const CsvTable table = read_csv(run_directory / "surveyed.csv");
  const auto x = table.numbers("x"), y = table.numbers("y");
  for (std::size_t i = 0; i < x.size(); ++i) places.emplace_back(x[i], y[i]);
  return places;
}

/// Bounds of the map figure: paths, anchors, surveyed landmarks, and landmarks of usual accuracy.
Box map_box(const CsvTable& map, const Trajectory& estimate, const Trajectory& truth,
            const std::vector<Eigen::Vector2d>& surveyed) {
  Box box;
  for (const Eigen::Vector2d& position : surveyed) box.include(position.x(), position.y());
  for (const Trajectory* path : {&estimate, &truth})
    for (const StampedPose& pose : *path) box.include(pose.position.x(), pose.position.y());
  const auto x = map.numbers("x"), y = map.numbers("y"), pxx = map.numbers("pxx"), pyy = map.numbers("pyy");
  std::vector<double> sigmas;
  for (std::size_t i = 0; i < x.size(); ++i) sigmas.push_back(std::sqrt(std::max(0.0, pxx[i] + pyy[i])));
  const double usual = 5 * quantile(sigmas, 0.5) + 0.1;  // a few far less accurate ones may be cut off
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (sigmas[i] > usual) continue;
    box.include(x[i] - 2 * std::sqrt(std::max(0.0, pxx[i])), y[i] - 2 * std::sqrt(std::max(0.0, pyy[i])));
    box.include(x[i] + 2 * std::sqrt(std::max(0.0, pxx[i])), y[i] + 2 * std::sqrt(std::max(0.0, pyy[i])));
  }
  return box;
}

/// One panel of errors with bounds. `scale` converts the table's unit to that of the axis.
std::string error_panel(const CsvTable& series, const std::string& column, const std::string& label,
                        double scale, bool with_errors, bool last_row) {
  auto shown = finite(series.numbers("two_sigma_" + column));
  double limit = quantile(shown, 0.97);
  if (with_errors)
    for (const double e : finite(series.numbers("error_" + column))) limit = std::max(limit, std::abs(e));
  if (!(limit > 0)) limit = 1;
  std::string panel = fmt::format("set ylabel '{}'\nset yrange [{}:{}]\n", label, -1.12 * scale * limit,
                                  1.12 * scale * limit);
  panel += last_row ? "set xlabel 't, s'\nset format x '%g'\n" : "unset xlabel\nset format x ''\n";
  panel += fmt::format(
      "bound(s) = s * {0} * column('two_sigma_{1}')\n"
      "plot 'series.csv' using (column('t')):(bound(-1)):(bound(1)) with filledcurves linecolor rgb "
      "'#dbe9f4' title '2σ', \\\n"
      "     '' using (column('t')):(bound(1)) with lines linecolor rgb sky linewidth 0.9 notitle, \\\n"
      "     '' using (column('t')):(bound(-1)) with lines linecolor rgb sky linewidth 0.9 notitle",
      scale, column);
  if (with_errors)
    panel += fmt::format(
        ", \\\n     '' using (column('t')):({} * column('error_{}')) with lines linecolor rgb orange "
        "linewidth 1.2 title 'error'",
        scale, column);
  return panel + "\nunset key\nunset title\n";
}

/// Times at which a landmark was added.
std::vector<double> additions(const CsvTable& series) {
  const auto t = series.numbers("t"), landmarks = series.numbers("landmarks");
  std::vector<double> times;
  for (std::size_t i = 0; i < t.size(); ++i)
    if (landmarks[i] > (i == 0 ? 0 : landmarks[i - 1])) times.push_back(t[i]);
  return times;
}

/// Data block `t t_next candidate score` of the action chosen at each decision.
std::string chosen_block(const CsvTable& actions) {
  const auto t = actions.numbers("t");
  const std::size_t chosen = *actions.find("chosen");
  std::string block = "$chosen << EOD\n";
  for (std::size_t i = 0; i < t.size(); ++i) {
    const auto column =
        std::find(actions.columns.begin() + 2, actions.columns.end(), actions.rows[i][chosen]);
    if (column == actions.columns.end()) continue;
    const auto k = static_cast<std::size_t>(column - actions.columns.begin());
    const double next = i + 1 < t.size() ? t[i + 1] : t[i] + (i > 0 ? t[i] - t[i - 1] : 1.0);
    block += fmt::format("{},{},{},{}\n", t[i], next, k - 2, actions.rows[i][k]);
  }
  return block + "EOD\n";
}

constexpr const char* candidate_colors[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00",
                                            "#56b4e9", "#7a5195", "#8c6d31", "#555555", "#b5a900"};
std::string candidate_color(std::size_t i) { return candidate_colors[i % std::size(candidate_colors)]; }

std::string score_panel(const CsvTable& actions) {
  std::string panel =
      "set ylabel 'score, nats'\nunset xlabel\nset format x ''\nset key outside right top vertical "
      "noenhanced\nplot ";
  for (std::size_t k = 2; k < actions.columns.size(); ++k)
    panel += fmt::format(
        "'actions.csv' using 1:{} with steps linecolor rgb '{}' linewidth 1.3 title {}, \\\n     ", k + 1,
        candidate_color(k - 2), gnuplot_string(actions.columns[k]));
  return panel +
         "$chosen using 1:4 with points pointtype 6 pointsize 0.7 linecolor rgb ink linewidth 1.2 title "
         "'chosen'\n";
}

std::string chosen_panel(const CsvTable& actions) {
  std::string panel = fmt::format(
      "unset key\nset format x '%g'\nset xlabel 't, s'\nset ylabel 'chosen'\nset yrange [{}:-0.7]\n",
      static_cast<double>(actions.columns.size() - 2) - 0.3);
  panel += "unset grid\nset grid ytics linecolor '#e4e4e4' linetype 1 linewidth 0.6\nset ytics noenhanced (";
  for (std::size_t k = 2; k < actions.columns.size(); ++k)
    panel += fmt::format("{}{} {}", k > 2 ? ", " : "", gnuplot_string(actions.columns[k]), k - 2);
  panel += ")\nset style fill solid 0.9 noborder\nplot ";
  for (std::size_t k = 2; k < actions.columns.size(); ++k)
    panel += fmt::format(
        "{}$chosen using 1:($3 == {} ? $3 : NaN):1:2:($3 - 0.32):($3 + 0.32) with boxxyerror linecolor rgb "
        "'{}'",
        k > 2 ? ", \\\n     " : "", k - 2, candidate_color(k - 2));
  return panel + "\n";
}

/// Whether this pose component is estimated: a planar vehicle has no height, roll and pitch, for example.
bool can_err(const CsvTable& series, const std::string& column) {
  const auto bound = finite(series.numbers("two_sigma_" + column));
  return std::any_of(bound.begin(), bound.end(), [](double b) { return b != 0; });
}

}  // namespace

std::optional<std::string> map_script(const fs::path& run_directory, AlignmentKind alignment) {
  const CsvTable map = read_csv(run_directory / "map.csv");
  const Trajectory estimate = poses_if_any(run_directory / "estimate.tum");
  const Trajectory truth = truth_on_estimate(poses_if_any(run_directory / "truth.tum"), estimate, alignment);
  const auto surveyed = surveyed_places(run_directory);
  const Box box = map_box(map, estimate, truth, surveyed);
  if (box.empty()) return std::nullopt;
  const double margin = 0.06 * std::max({box.high[0] - box.low[0], box.high[1] - box.low[1], 0.2});
  const bool moved = alignment != AlignmentKind::none && !truth.empty();
  std::string script = figure_head("map", 760, 720);
  if (moved) script += path_block("truth", truth);
  script += fmt::format(
      "set datafile separator ', '  # tables and TUM files in one plot\n"
      "set size ratio -1\nset xrange [{}:{}]\nset yrange [{}:{}]\nset xlabel '{}'\nset ylabel '{}'\n"
      "set key outside top center horizontal maxrows 1\nset style fill transparent solid 0.18\n",
      box.low[0] - margin, box.high[0] + margin, box.low[1] - margin, box.high[1] + margin,
      axis_label("x", alignment), axis_label("y", alignment));
  script +=  // map.csv columns: 3 x, 4 y, 6 pxx, 7 pxy, 9 pyy; closed-form eigenvalues of a 2x2 covariance
      "root(pxx,pxy,pyy) = sqrt(0.25 * (pxx - pyy)**2 + pxy**2)\n"
      "long(pxx,pxy,pyy) = 4 * sqrt(0.5 * (pxx + pyy) + root(pxx,pxy,pyy))\n"
      "short(pxx,pxy,pyy) = 4 * sqrt(abs(0.5 * (pxx + pyy) - root(pxx,pxy,pyy)))\n"
      "turn(pxx,pxy,pyy) = 90 / pi * atan2(2 * pxy, pxx - pyy)\n"
      "mapped(v) = stringcolumn(2) eq 'landmark' ? v : NaN\n"
      "anchor(v) = stringcolumn(2) eq 'anchor' ? v : NaN\n"
      "plot 'map.csv' skip 1 using (mapped($3)):4:(long($6,$7,$9)):(short($6,$7,$9)):(turn($6,$7,$9)) \\\n"
      "       with ellipses linecolor rgb blue linewidth 0.7 title 'landmarks, 2σ', \\\n"
      "     '' skip 1 using (mapped($3)):4 with points pointtype 7 pointsize 0.25 linecolor rgb blue "
      "notitle, \\\n"
      "     '' skip 1 using (anchor($3)):4 with points pointtype 9 pointsize 1.0 linecolor rgb amber title "
      "'anchors'";
  if (!surveyed.empty())
    script +=
        ", \\\n     'surveyed.csv' skip 1 using 2:3 with points pointtype 6 pointsize 1.0 linecolor rgb ink "
        "linewidth 0.9 title 'surveyed'";
  if (!truth.empty())
    script += fmt::format(", \\\n     {} with lines linecolor rgb ink linewidth 1.3 title 'true path{}'",
                          moved ? "$truth using 1:2" : "'truth.tum' using 2:3", moved ? ", aligned" : "");
  if (!estimate.empty())
    script += fmt::format(
        ", \\\n     last = {}, 'estimate.tum' using (gap = $1 - last, last = $1, gap > {} ? NaN : $2):3 "
        "with lines linecolor rgb orange linewidth 1.3 title 'estimated path'",
        estimate.front().t, longest_step_s(estimate));
  return script + "\n";
}

std::optional<std::string> errors_script(const fs::path& run_directory, AlignmentKind alignment) {
  const CsvTable series = read_csv(run_directory / "series.csv");
  if (finite(series.numbers("two_sigma_x_m")).empty()) return std::nullopt;
  const bool with_errors = series.find("error_x_m").has_value(), spatial = can_err(series, "z_m");
  const bool metric = alignment != AlignmentKind::sim3;
  std::vector<std::pair<std::string, std::string>> positions, turns;  // column and label of each panel
  for (const char* axis : {"x", "y", "z"})
    if (spatial || can_err(series, std::string(axis) + "_m"))
      positions.emplace_back(std::string(axis) + "_m", std::string(axis) + (metric ? ", cm" : ", arbitrary"));
  for (const char* axis : {"x", "y", "z"})
    if (spatial || can_err(series, std::string("rot") + axis + "_rad"))
      turns.emplace_back(std::string("rot") + axis + "_rad",
                         spatial ? std::string("about ") + axis + ", °" : "heading, °");
  const std::size_t rows = spatial ? 3 : std::max<std::size_t>(1, positions.size() + turns.size());
  std::string script = figure_head("errors", spatial ? 1000 : 760, rows < 3 ? 420 : 660) + time_range(series);
  script += fmt::format(
      "set datafile columnheaders\nset multiplot layout {},{} columnsfirst margins {},0.985,0.135,0.91 "
      "spacing 0.13,0.04\nset key at screen 0.515,0.99 center top horizontal maxrows 1\n",
      rows, spatial ? 2 : 1, spatial ? 0.075 : 0.1);
  const char* unit = metric ? "" : " (scale unobservable: arbitrary units)";
  if (spatial) script += fmt::format("set title 'position, world axes{}'\n", unit);
  for (std::size_t i = 0; i < positions.size(); ++i)
    script += error_panel(series, positions[i].first, positions[i].second, metric ? 100 : 1, with_errors,
                          i + 1 == positions.size() && (spatial || turns.empty()));
  if (spatial) script += "set title 'rotation, body axes'\n";
  constexpr double degrees = 180 / std::numbers::pi;
  for (std::size_t i = 0; i < turns.size(); ++i)
    script +=
        error_panel(series, turns[i].first, turns[i].second, degrees, with_errors, i + 1 == turns.size());
  return script + "unset multiplot\n";
}

std::optional<std::string> entropy_script(const fs::path& run_directory, AlignmentKind) {
  const CsvTable series = read_csv(run_directory / "series.csv");
  if (finite(series.numbers("entropy_total_nats")).empty()) return std::nullopt;
  std::string script = figure_head("entropy", 900, 560) + time_range(series) + "set datafile columnheaders\n";
  for (const double t : additions(series))
    script += fmt::format(
        "set arrow from {0}, graph 0 to {0}, graph 1 nohead back linecolor rgb '#cfcfcf' linewidth 0.7\n", t);
  // gnuplot draws no key sample for an arrow, so a line of the same style is drawn outside of the plot.
  script +=
      "set multiplot layout 2,1 margins 0.1,0.985,0.13,0.91 spacing 0,0.05\n"
      "set key at screen 0.985,0.985 right top horizontal maxrows 1\nset format x ''\nset ylabel 'whole "
      "state, nats'\n"
      "plot 'series.csv' using (column('t')):(column('entropy_total_nats')) with lines linecolor rgb ink "
      "linewidth 1.5 title 'total', \\\n"
      "     '' using (column('t')):(column('entropy_map_nats')) with lines linecolor rgb blue linewidth 1.5 "
      "title 'map', \\\n"
      "     NaN with lines linecolor rgb orange linewidth 1.5 title 'vehicle', \\\n"
      "     NaN with lines linecolor rgb '#cfcfcf' linewidth 0.9 title 'landmark added'\n"
      "unset key\nset format x '%g'\nset xlabel 't, s'\nset ylabel 'vehicle, nats'\n"
      "plot 'series.csv' using (column('t')):(column('entropy_vehicle_nats')) with lines linecolor rgb "
      "orange linewidth 1.5\n"
      "unset multiplot\n";
  return script;
}

std::optional<std::string> decision_script(const fs::path& run_directory, AlignmentKind) {
  const CsvTable actions = read_csv(run_directory / "actions.csv");
  if (actions.rows.empty() || actions.columns.size() < 3) return std::nullopt;
  std::string script = figure_head("decision", 960, 600);
  const CsvTable series = read_csv(run_directory / "series.csv");
  script += time_range(series) + chosen_block(actions);
  script += "set multiplot\nset lmargin at screen 0.15\nset rmargin at screen 0.80\n";
  script += "set tmargin at screen 0.95\nset bmargin at screen 0.46\n" + score_panel(actions);
  script += "set tmargin at screen 0.42\nset bmargin at screen 0.12\n" + chosen_panel(actions);
  return script + "unset multiplot\n";
}

}  // namespace incognita
