#include "incognita/report/team_figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <utility>
#include <vector>

#include "incognita/record/files/csv_table.hpp"
#include "incognita/report/figure_style.hpp"
#include "incognita/report/gnuplot.hpp"

namespace incognita {
namespace fs = std::filesystem;
namespace {

constexpr const char* colors[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"};
constexpr std::size_t most_named = 6;  // more colors cannot be told apart in a key

std::string color(std::size_t vehicle) { return colors[vehicle % std::size(colors)]; }

std::optional<CsvTable> vehicles_of(const fs::path& run_directory) {
  const fs::path file = run_directory / "vehicles.csv";
  if (!fs::exists(file)) return std::nullopt;
  CsvTable table = read_csv(file);
  if (table.rows.empty()) return std::nullopt;
  return table;
}

std::size_t count_of(const CsvTable& vehicles) {
  const auto which = vehicles.numbers("vehicle");
  return static_cast<std::size_t>(*std::max_element(which.begin(), which.end()));
}

bool knows(const CsvTable& table, const char* column) {
  const auto values = table.numbers(column);
  return std::any_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
}

/// Motion on a line has no top view.
bool on_line(const CsvTable& table) {
  const auto y = table.numbers("y_m"), sigma = table.numbers("two_sigma_y_m");
  const auto nothing = [](double v) { return !std::isfinite(v) || v == 0; };
  return std::all_of(y.begin(), y.end(), nothing) && std::all_of(sigma.begin(), sigma.end(), nothing);
}

/// Line through the rows of one vehicle; each tick has one row per vehicle.
std::string line(std::size_t vehicle, std::size_t vehicles, const std::string& x, const std::string& y,
                 const std::string& style, const std::string& title) {
  return fmt::format("'vehicles.csv' every {}::{} using (column('{}')):(column('{}')) with lines {} {}",
                     vehicles, vehicle, x, y, style,
                     title.empty() ? "notitle" : "title " + gnuplot_string(title));
}

std::string join(const std::vector<std::string>& plots) {
  return fmt::format("plot {}\n", fmt::join(plots, ", \\\n     "));
}

std::string of_vehicle(std::size_t i) { return fmt::format("linecolor rgb '{}' linewidth 1.2", color(i)); }

/// "input_speed_m_s" becomes "speed, m/s".
std::string label_of(const std::string& input) {
  constexpr std::pair<const char*, const char*> units[] = {{"_m_s2", ", m/s²"},
                                                           {"_rad_s2", ", rad/s²"},
                                                           {"_m_s", ", m/s"},
                                                           {"_rad_s", ", rad/s"},
                                                           {"_rad", ", rad"}};
  std::string label = input.substr(std::string("input_").size());
  for (const auto& [ending, unit] : units)
    if (label.ends_with(ending)) {
      label = label.substr(0, label.size() - std::string(ending).size()) + unit;
      break;
    }
  std::replace(label.begin(), label.end(), '_', ' ');
  return label;
}

struct InputPanel {
  std::string label;
  std::vector<std::string> lines;
};

/// One panel per input with the first `most_named` vehicles; for a body in space only the accelerations of the
/// first, three per panel.
std::vector<InputPanel> input_panels(const CsvTable& table, std::size_t vehicles) {
  std::vector<std::string> inputs;
  std::copy_if(table.columns.begin(), table.columns.end(), std::back_inserter(inputs),
               [&](const std::string& column) {
                 return column.starts_with("input_") && knows(table, column.c_str());
               });
  std::vector<InputPanel> panels;
  if (inputs.size() == 6) {
    for (const std::size_t first : {0u, 3u}) {
      InputPanel& panel = panels.emplace_back(first == 0 ? "acceleration, m/s²" : "angular, rad/s²");
      for (std::size_t axis = 0; axis < 3; ++axis)
        panel.lines.push_back(line(0, vehicles, "t", inputs[first + axis], of_vehicle(axis),
                                   fmt::format("{} {}", first == 0 ? "along" : "about", "xyz"[axis])));
    }
    return panels;
  }
  for (const std::string& input : inputs) {
    InputPanel& panel = panels.emplace_back(label_of(input));
    for (std::size_t i = 0; i < std::min(vehicles, most_named); ++i)
      panel.lines.push_back(line(i, vehicles, "t", input, of_vehicle(i), ""));
  }
  return panels;
}

struct MapBlocks {
  std::string blocks;  ///< data blocks $landmarks and $anchors
  bool landmarks = false, anchors = false;
};

/// x, y and the 2-sigma ellipse (diameters, orientation in degrees) of a 2x2 covariance in closed form.
MapBlocks map_blocks(const fs::path& run_directory) {
  const CsvTable table = read_csv(run_directory / "map.csv");
  const auto x = table.numbers("x"), y = table.numbers("y"), pxx = table.numbers("pxx"),
             pxy = table.numbers("pxy"), pyy = table.numbers("pyy");
  const std::size_t kind = *table.find("kind");
  std::string landmarks = "$landmarks << EOD\nx,y,long,short,turn\n", anchors = "$anchors << EOD\nx,y\n";
  MapBlocks map;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (table.rows[i][kind] == "anchor") {
      anchors += fmt::format("{},{}\n", x[i], y[i]);
      map.anchors = true;
      continue;
    }
    const double mean = 0.5 * (pxx[i] + pyy[i]), root = std::hypot(0.5 * (pxx[i] - pyy[i]), pxy[i]);
    landmarks += fmt::format("{},{},{},{},{}\n", x[i], y[i], 4 * std::sqrt(std::max(0.0, mean + root)),
                             4 * std::sqrt(std::max(0.0, mean - root)),
                             90 / std::numbers::pi * std::atan2(2 * pxy[i], pxx[i] - pyy[i]));
    map.landmarks = true;
  }
  map.blocks = landmarks + "EOD\n" + anchors + "EOD\n";
  return map;
}

}  // namespace

std::optional<std::string> vehicles_script(const fs::path& run_directory, AlignmentKind alignment) {
  const auto table = vehicles_of(run_directory);
  if (!table || !knows(*table, "x_m") || on_line(*table) || alignment != AlignmentKind::none)
    return std::nullopt;
  std::vector<std::string> plots;
  const std::size_t vehicles = count_of(*table);
  if (vehicles < 2 && !knows(*table, "reference_x_m"))
    return std::nullopt;  // the figure `map` shows the same
  for (std::size_t i = 0; i < vehicles; ++i) {
    const bool named = i < most_named;
    if (knows(*table, "reference_x_m"))
      plots.push_back(line(i, vehicles, "reference_x_m", "reference_y_m",
                           "linecolor rgb '#c8c8c8' linewidth 4", i == 0 ? "reference" : ""));
    if (knows(*table, "true_x_m"))
      plots.push_back(
          line(i, vehicles, "true_x_m", "true_y_m", "linecolor rgb ink linewidth 1.6", i == 0 ? "true" : ""));
    plots.push_back(line(i, vehicles, "x_m", "y_m", of_vehicle(i),
                         named ? fmt::format("vehicle {}, estimated", i + 1) : ""));
  }
  const MapBlocks map = map_blocks(run_directory);
  if (map.anchors)
    plots.insert(
        plots.begin(),
        "$anchors using 1:2 with points pointtype 9 pointsize 1 linecolor rgb amber title 'anchors'");
  if (map.landmarks) {
    plots.insert(plots.begin(),
                 "$landmarks using 1:2 with points pointtype 7 pointsize 0.3 linecolor rgb blue notitle");
    plots.insert(
        plots.begin(),
        "$landmarks using 1:2:3:4:5 with ellipses linecolor rgb blue linewidth 0.7 fillstyle transparent "
        "solid 0.18 title 'landmarks, 2σ'");
  }
  return figure_head("vehicles", 760, 720) + map.blocks +
         "set datafile columnheaders\nset size ratio -1\nset xlabel 'x, m'\nset ylabel 'y, m'\n"
         "set key outside top center horizontal\nset offsets graph 0.05, graph 0.05, graph 0.05, graph "
         "0.05\n" +
         join(plots);
}

std::optional<std::string> control_script(const fs::path& run_directory, AlignmentKind) {
  const auto table = vehicles_of(run_directory);
  if (!table || !knows(*table, "reference_x_m")) return std::nullopt;
  const std::size_t vehicles = count_of(*table);
  std::vector<InputPanel> panels{{"distance to path, m", {}}};
  const bool known = knows(*table, "from_path_m");
  for (std::size_t i = 0; known && i < std::min(vehicles, most_named); ++i)
    panels.front().lines.push_back(
        line(i, vehicles, "t", "from_path_m", of_vehicle(i), fmt::format("vehicle {}", i + 1)));
  if (!known) panels.clear();
  for (InputPanel& panel : input_panels(*table, vehicles)) panels.push_back(std::move(panel));
  if (panels.empty()) return std::nullopt;
  std::string script = figure_head("control", 900, 120 + 190 * static_cast<int>(panels.size()));
  script += fmt::format(
      "set datafile columnheaders\nset multiplot layout {},1 margins 0.11,0.985,0.1,0.95 spacing 0,0.04\n"
      "set key inside right top horizontal\n",
      panels.size());
  for (std::size_t k = 0; k < panels.size(); ++k) {
    const bool logarithmic = known && k == 0, last = k + 1 == panels.size();
    script += fmt::format("set ylabel {}\n{}{}{}{}", gnuplot_string(panels[k].label),
                          logarithmic ? "set logscale y\nset format y '10^{%T}'\n" : "",
                          last ? "set xlabel 't, s'\nset format x '%g'\n" : "set format x ''\n",
                          join(panels[k].lines), logarithmic ? "unset logscale y\nset format y '%g'\n" : "");
  }
  return script + "unset multiplot\n";
}

}  // namespace incognita
