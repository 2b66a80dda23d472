#include "incognita/report/plot.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string_view>
#include <system_error>

#include "incognita/messages/errors.hpp"
#include "incognita/record/files/number.hpp"
#include "incognita/record/files/row_file.hpp"
#include "incognita/report/figure_style.hpp"
#include "incognita/report/gnuplot.hpp"

namespace incognita {
namespace fs = std::filesystem;
namespace {

constexpr double gap = std::numeric_limits<double>::quiet_NaN();
constexpr int wide_panel_px = 760, panel_px = 480;      // panel alone in its row, or not
constexpr int low_panel_px = 300, high_panel_px = 440;  // height of a time series, and of a map or surface
constexpr Color turns[] = {Color::blue,  Color::orange, Color::green, Color::pink,
                           Color::amber, Color::sky,    Color::ink,   Color::gray};

[[noreturn]] void refuse(const Plot& plot, const std::string& what) {
  throw std::invalid_argument("plot `" + plot.id + "`: " + what);
}

void check_range(const Plot& plot, const std::optional<std::pair<double, double>>& range, bool log) {
  if (!range) return;
  const auto [low, high] = *range;
  if (!std::isfinite(low) || !std::isfinite(high) || low >= high || (log && low <= 0))
    refuse(plot, fmt::format("a range from {} to {}", low, high));
}

void check_panel(const Plot& plot, const Panel& panel) {
  if (!panel.surfaces.empty() && (!panel.curves.empty() || panel.log_y || panel.equal_axes))
    refuse(plot, "a panel of surfaces has no curves, logarithms or equal axes");
  check_range(plot, panel.x_range, false);
  check_range(plot, panel.y_range, panel.log_y);
  for (const Curve& c : panel.curves) {
    const std::size_t wanted_y2 = c.style == Style::band ? c.x.size() : 0;
    if (c.y.size() != c.x.size() || c.y2.size() != wanted_y2)
      refuse(plot, fmt::format("curve `{}` has {} x, {} y and {} y2", c.label, c.x.size(), c.y.size(),
                               c.y2.size()));
  }
  for (const Surface& s : panel.surfaces)
    if (s.x.size() < 2 || s.y.size() < 2 || s.z.size() != s.x.size() * s.y.size())
      refuse(plot, fmt::format("surface `{}` has {} x, {} y and {} z", s.label, s.x.size(), s.y.size(),
                               s.z.size()));
}

void check(const Plot& plot) {
  constexpr std::string_view allowed = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-._";
  if (plot.id.empty() || plot.id.front() == '.' || plot.id.find_first_not_of(allowed) != std::string::npos)
    refuse(plot, "its id is not a file name");
  if (plot.columns < 1 || plot.panels.empty()) refuse(plot, "nothing to draw");
  for (const Panel& panel : plot.panels) check_panel(plot, panel);
}

// The table -----------------------------------------------------------------------------------------------

constexpr const char* table_header = "panel,curve,x,y,y2_or_z,label\n";

void append_row(std::string& table, const std::string& place, double x, double y, std::optional<double> z,
                const std::string& label) {
  table += place;
  append_cell(table, x);
  append_cell(table, y);
  if (z)
    append_cell(table, *z);
  else
    table += ',';
  append_cell(table, label);
  table += '\n';
}

void append_rows(std::string& table, const std::string& place, const Curve& c) {
  for (std::size_t i = 0; i < c.x.size(); ++i)
    append_row(table, place, c.x[i], c.y[i], c.y2.empty() ? std::nullopt : std::optional(c.y2[i]), c.label);
}

void append_rows(std::string& table, const std::string& place, const Surface& s) {
  for (std::size_t i = 0; i < s.z.size(); ++i)
    append_row(table, place, s.x[i % s.x.size()], s.y[i / s.x.size()], s.z[i], s.label);
}

std::string table_of(const Plot& plot) {
  std::string table = table_header;
  int panel_number = 0;
  for (const Panel& panel : plot.panels) {
    ++panel_number;
    int number = 0;
    for (const Curve& c : panel.curves) append_rows(table, fmt::format("{},{}", panel_number, ++number), c);
    for (const Surface& s : panel.surfaces)
      append_rows(table, fmt::format("{},{}", panel_number, ++number), s);
  }
  return table;
}

// The script ----------------------------------------------------------------------------------------------

const char* name(Color color) {
  switch (color) {
    case Color::blue:
      return "blue";
    case Color::orange:
      return "orange";
    case Color::green:
      return "green";
    case Color::pink:
      return "pink";
    case Color::amber:
      return "amber";
    case Color::sky:
      return "sky";
    case Color::gray:
      return "gray";
    case Color::ink:
    case Color::automatic:
      break;
  }
  return "ink";
}

/// Assigns palette colors to curves without their own.
class Palette {
 public:
  const char* color(Color wanted) {
    return name(wanted == Color::automatic ? turns[next_++ % std::size(turns)] : wanted);
  }

 private:
  std::size_t next_ = 0;
};

struct CurveStyle {
  const char *columns, *shape, *pen;  ///< columns to plot, plotting style, and attributes besides the color
};

CurveStyle style_of(Style style) {
  switch (style) {
    case Style::line:
      break;
    case Style::dashed:
      return {"3:4", "lines linecolor", "linewidth 1.3 dashtype 2"};
    case Style::thin:
      return {"3:4", "lines linecolor", "linewidth 0.6"};
    case Style::steps:
      return {"3:4", "steps linecolor", "linewidth 1.3"};
    case Style::points:
      return {"3:4", "points linecolor", "pointtype 7 pointsize 0.35"};
    case Style::band:
      return {"3:4:5", "filledcurves fillcolor", "fillstyle transparent solid 0.18 noborder"};
    case Style::circles:
      return {"3:4", "points linecolor", "pointtype 6 pointsize 0.9 linewidth 1.3"};
    case Style::crosses:
      return {"3:4", "points linecolor", "pointtype 2 pointsize 0.9 linewidth 1.3"};
    case Style::stars:
      return {"3:4", "points linecolor", "pointtype 3 pointsize 0.9 linewidth 1.3"};
  }
  return {"3:4", "lines linecolor", "linewidth 1.3"};
}

std::string title_of(const std::string& label) {
  return label.empty() ? "notitle" : "title " + gnuplot_string(label);
}

bool is_drawn(double y, bool log) { return std::isfinite(y) && (!log || y > 0); }

bool has_points(const Curve& c, bool log) {
  for (std::size_t i = 0; i < c.x.size(); ++i)
    if (std::isfinite(c.x[i]) && is_drawn(c.y[i], log) && (c.y2.empty() || is_drawn(c.y2[i], log)))
      return true;
  return false;
}

/// Assigns table rows to successive curves; the header does not count.
class Rows {
 public:
  std::string next(std::size_t count) {
    const std::size_t first = begin_;
    begin_ += count;
    return fmt::format("every ::{}::{}", first, begin_ - 1);
  }

 private:
  std::size_t begin_ = 0;
};

std::string range_text(const char* axis, const std::optional<std::pair<double, double>>& range,
                       const std::string& otherwise) {
  const std::string text =
      range ? fmt::format("[{}:{}]", range->first, range->second) : otherwise;  // both formats round-trip
  return fmt::format("set {}range {}\n", axis, text);
}

constexpr const char* own_tics = "set xtics autofreq\nset ytics autofreq\n";
using Range = std::pair<double, double>;

/// Range of the plotted values; 0 if there are none.
double extent(const Panel& panel, const std::vector<std::vector<double> Curve::*>& of) {
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (const Curve& c : panel.curves)
    for (const auto values : of)
      for (const double value : c.*values)
        if (std::isfinite(value)) least = std::min(least, value), most = std::max(most, value);
  return least <= most ? most - least : 0;
}

/// Tic distance that gives six or fewer tics: 1, 2 or 5 times a power of ten.
double tic_of(double length) {
  if (!(length > 0)) return 1;
  const double least = length / 6, power = std::pow(10, std::floor(std::log10(least)));
  for (const double step : {1.0, 2.0, 5.0})
    if (step * power >= least) return step * power;
  return 10 * power;
}

/// Same tic distance on both axes: gnuplot's own choice differs per axis, and labels of the shorter one
/// overlap. gnuplot extends each axis to the next tic.
std::string equal_axes(const Panel& panel) {
  const auto shown = [](const std::optional<Range>& range, double otherwise) {
    return range ? range->second - range->first : otherwise;
  };
  const double tic = tic_of(std::max(shown(panel.x_range, extent(panel, {&Curve::x})),
                                     shown(panel.y_range, extent(panel, {&Curve::y, &Curve::y2}))));
  return fmt::format("set size ratio -1\nset xtics {0:g}\nset ytics {0:g}\n", tic);
}

std::string names(const std::vector<std::string>& of_y) {
  if (of_y.empty()) return "";
  std::vector<std::string> tics;
  for (const std::string& name : of_y)
    tics.push_back(fmt::format("{} {}", gnuplot_string(name), tics.size()));
  return fmt::format("set ytics ({})\n", fmt::join(tics, ", "));
}

std::string curve_axes(const Panel& panel) {
  // gnuplot refuses to draw an axis without a range.
  const bool empty = std::none_of(panel.curves.begin(), panel.curves.end(),
                                  [&](const Curve& c) { return has_points(c, panel.log_y); });
  std::string text = "set border 3\nset key tmargin center horizontal\n";
  text += panel.log_y ? "set logscale y\nset format y '%g'\n" : "unset logscale y\n";
  const std::string fitted = panel.equal_axes ? "[*:*]" : "[*:*] noextend";
  text += range_text("x", panel.x_range, empty ? "[0:1]" : fitted);
  text += range_text("y", panel.y_range, empty ? (panel.log_y ? "[1:10]" : "[0:1]") : "[*:*]");
  text += panel.equal_axes ? equal_axes(panel) : std::string("set size noratio\n") + own_tics;
  return text + names(panel.y_names);
}

std::string curves_script(const Panel& panel, Rows& rows) {
  std::vector<std::string> parts;
  Palette palette;
  for (const Curve& c : panel.curves) {
    const std::string place = rows.next(c.x.size());
    const CurveStyle match = style_of(c.style);
    const std::string drawn = fmt::format("with {} rgb {} {} {}", match.shape, palette.color(c.color),
                                          match.pen, title_of(c.label));
    if (has_points(c, panel.log_y))
      parts.push_back(fmt::format("data skip 1 {} using {} {}", place, match.columns, drawn));
    else if (!c.label.empty())  // keeps an empty curve in the key
      parts.push_back("NaN " + drawn);
  }
  if (parts.empty()) parts.emplace_back("NaN notitle");
  return curve_axes(panel) + fmt::format("plot {}\n", fmt::join(parts, ", \\\n     "));
}

std::string block_name(std::size_t panel, std::size_t surface) {
  return fmt::format("$net_{}_{}", panel + 1, surface + 1);
}

/// gnuplot needs a mesh as lines of points separated by blank lines, which the table does not contain.
std::string net_script(const Surface& s, const std::string& block, Rows& rows) {
  return fmt::format(
      "array net_x[{0}]; array net_y[{0}]; array net_z[{0}]; n = 0\n"
      "stats data skip 1 {1} using (n = n + 1, net_x[n] = $3, net_y[n] = $4, net_z[n] = $5, 0) nooutput\n"
      "set print {2}\n"
      "do for [i = 1:{0}] {{\n"
      "  print sprintf('%.17g,%.17g,%.17g', net_x[i], net_y[i], net_z[i])\n"
      "  if (i % {3} == 0) {{ print '' }}\n"
      "}}\n"
      "unset print\n",
      s.z.size(), rows.next(s.z.size()), block, s.x.size());
}

std::string surfaces_script(const Panel& panel, std::size_t panel_index) {
  std::vector<std::string> parts;
  Palette palette;
  for (std::size_t i = 0; i < panel.surfaces.size(); ++i) {
    const Surface& s = panel.surfaces[i];
    const char* color = palette.color(s.color);
    if (std::none_of(s.z.begin(), s.z.end(), [](double z) { return std::isfinite(z); })) continue;
    parts.push_back(fmt::format("{} using 1:2:3 with lines linecolor rgb {} linewidth 0.7 {}",
                                block_name(panel_index, i), color, title_of(s.label)));
  }
  std::string text = "set border 31\nset key bmargin center horizontal\nunset logscale y\nset size noratio\n";
  text += own_tics;
  text += range_text("x", panel.x_range, "[*:*] noextend") + range_text("y", panel.y_range, "[*:*] noextend");
  text += "set zlabel " + gnuplot_string(panel.z_label) + " rotate by 90\n";
  if (parts.empty()) return text + "set xrange [0:1]\nset yrange [0:1]\nplot NaN notitle\n";
  return text + fmt::format("splot {}\n", fmt::join(parts, ", \\\n      "));
}

std::string panel_script(const Panel& panel, std::size_t index, Rows& rows) {
  std::string text = "\n";
  text += "set title " + gnuplot_string(panel.title) + "\n";
  text += "set xlabel " + gnuplot_string(panel.x_label) + "\n";
  text += "set ylabel " + gnuplot_string(panel.y_label) + "\n";
  return text + (panel.surfaces.empty() ? curves_script(panel, rows) : surfaces_script(panel, index));
}

std::string script_of(const Plot& plot) {
  const int count = static_cast<int>(plot.panels.size());
  const int columns = std::min(plot.columns, count), lines = (count + columns - 1) / columns;
  const bool high = count == 1 || std::any_of(plot.panels.begin(), plot.panels.end(), [](const Panel& p) {
                      return p.equal_axes || !p.surfaces.empty();
                    });
  std::string text = figure_head(plot.id, columns == 1 ? wide_panel_px : columns * panel_px,
                                 lines * (high ? high_panel_px : low_panel_px) + 20);
  text += fmt::format(
      "set termoption noenhanced\nset datafile missing\n"
      "set view 60,32\nset xyplane relative 0\nset hidden3d nooffset\n"
      "data = 'figures/{}.csv'  # each curve is in the rows named after `every`, counted from 0\n",
      plot.id);
  Rows rows;
  std::string nets, panels;
  for (std::size_t i = 0; i < plot.panels.size(); ++i) {
    const Panel& panel = plot.panels[i];
    panels += panel_script(panel, i, rows);
    for (std::size_t k = 0; k < panel.surfaces.size(); ++k)
      nets += net_script(panel.surfaces[k], block_name(i, k), rows);
  }
  text += nets + fmt::format("set multiplot layout {},{}", lines, columns);
  if (!plot.title.empty()) text += " title " + gnuplot_string(plot.title);
  return text + "\n" + panels + "\nunset multiplot\n";
}

}  // namespace

Curve ellipses(std::string label, const std::vector<Eigen::Vector2d>& means,
               const std::vector<Eigen::Matrix2d>& covariances, double sigmas) {
  if (means.size() != covariances.size())
    throw std::invalid_argument(
        fmt::format("ellipses: {} means, {} covariances", means.size(), covariances.size()));
  constexpr int corners = 48;
  Curve curve{std::move(label), Style::thin, {}, {}, {}, Color::automatic};
  for (std::size_t i = 0; i < means.size(); ++i) {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(covariances[i]);
    const Eigen::Matrix2d root =
        axes.eigenvectors() * axes.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal();
    for (int k = 0; k <= corners; ++k) {
      const double angle = 2 * std::numbers::pi * (k % corners) / corners;
      const Eigen::Vector2d p = means[i] + sigmas * root * Eigen::Vector2d(std::cos(angle), std::sin(angle));
      curve.x.push_back(p.x());
      curve.y.push_back(p.y());
    }
    curve.x.push_back(gap);
    curve.y.push_back(gap);
  }
  return curve;
}

Curve over_steps(std::string label, std::vector<double> y, Style style, double first) {
  Curve curve{std::move(label), style, {}, std::move(y), {}, Color::automatic};
  for (std::size_t i = 0; i < curve.y.size(); ++i) curve.x.push_back(first + static_cast<double>(i));
  return curve;
}

LedgerFigure draw_plot(const fs::path& out, const Plot& plot, std::vector<std::string>* warnings) {
  check(plot);
  std::error_code error;
  fs::create_directories(out / "figures", error);
  if (error) throw RecordError(write_failure(out / "figures", error.value()));
  const std::string stem = "figures/" + plot.id;
  write_whole_file(out / (stem + ".csv"), table_of(plot));
  write_whole_file(out / (stem + ".gp"), script_of(plot));
  const std::string warning = draw_script(out, plot.id);
  if (warnings && !warning.empty() &&
      std::find(warnings->begin(), warnings->end(), warning) == warnings->end())
    warnings->push_back(warning);
  return {plot.id, stem + ".svg", stem + ".csv"};
}

}  // namespace incognita
