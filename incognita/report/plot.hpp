// Figures as values: panels of curves, drawn by gnuplot from a data table stored beside the figure.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "incognita/report/ledger.hpp"

namespace incognita {

enum class Style {
  line,
  dashed,
  thin,    ///< for many similar lines, and outlines
  steps,   ///< holds each value until the next
  points,  ///< small dots
  band,    ///< filled between y and y2
  circles,
  crosses,
  stars
};

/// Colors of the common palette; `automatic` assigns them in turn to the curves of a panel.
enum class Color { automatic, blue, orange, green, pink, amber, sky, ink, gray };

/// NaN is a gap. Similar curves can share one key entry: leave the labels of all but one empty.
struct Curve {
  std::string label;  ///< plain text without markup; empty: not in the key
  Style style = Style::line;
  std::vector<double> x, y;     ///< of equal length
  std::vector<double> y2 = {};  ///< the second edge of a band, of the same length; else empty
  Color color = Color::automatic;
};

/// Heights over a grid, drawn as a mesh. NaN is a hole.
struct Surface {
  std::string label;
  std::vector<double> x, y;  ///< grid coordinates, two or more each
  std::vector<double> z;     ///< z[j * x.size() + i] at (x[i], y[j])
  Color color = Color::automatic;
};

/// Contains either curves or surfaces.
struct Panel {
  std::string title, x_label, y_label;
  std::vector<Curve> curves;  ///< later ones are drawn on top: bands first
  bool equal_axes = false;    ///< same scale in x and y
  std::optional<std::pair<double, double>> x_range = {}, y_range = {};  ///< default: fits the curves
  bool log_y = false;                                                   ///< nonpositive values are gaps
  std::vector<Surface> surfaces = {};
  std::string z_label = {};
  std::vector<std::string> y_names = {};  ///< labels of y = 0, 1, ... instead of numbers
};

struct Plot {
  std::string id;     ///< `fig-3.4`; used as file name: letters, digits, `-`, `.`, `_`
  std::string title;  ///< above all panels; may be empty
  int columns = 1;    ///< panels per row, filled row by row
  std::vector<Panel> panels;
};

/// One curve with the outlines of the covariance ellipses of that many sigmas. `means` and `covariances` have
/// the same length.
Curve ellipses(std::string label, const std::vector<Eigen::Vector2d>& means,
               const std::vector<Eigen::Matrix2d>& covariances, double sigmas = 2);

/// A curve of y over the time steps `first`, `first` + 1, ...
Curve over_steps(std::string label, std::vector<double> y, Style style = Style::line, double first = 0);

/// Writes three reproducible files: `figures/ID.csv` with all data (a row per point; panel and curve are
/// numbered from 1, `y2_or_z` is the second edge of a band or the height of a surface), the gnuplot script
/// `figures/ID.gp` that reads it (redraw with `gnuplot figures/ID.gp` in `out`), and `figures/ID.svg`.
///
/// If gnuplot is missing or fails, table and script remain and `warnings` (unless null) reports it once.
/// Throws std::invalid_argument for inconsistent lengths or an invalid id, RecordError if writing fails.
LedgerFigure draw_plot(const std::filesystem::path& out, const Plot& plot,
                       std::vector<std::string>* warnings);

}  // namespace incognita
