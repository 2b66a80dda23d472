// Figures as values: panels of curves, drawn by gnuplot from a table that stays beside the picture.
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
  thin,    ///< for many lines of one kind, and outlines
  steps,   ///< holds each value until the next
  points,  ///< small dots
  band,    ///< filled between y and y2
  circles,
  crosses,
  stars
};

/// Of the palette that all figures share; `automatic` takes its colours in turn, as the curves of a panel
/// come.
enum class Color { automatic, blue, orange, green, pink, amber, sky, ink, gray };

/// NaN is a gap. Curves of the same kind may share one entry of the key: leave the others' labels empty.
struct Curve {
  std::string label;  ///< plain text, nothing in it is markup; empty: not in the key
  Style style = Style::line;
  std::vector<double> x, y;     ///< of equal length
  std::vector<double> y2 = {};  ///< a band's other edge, as long; else empty
  Color color = Color::automatic;
};

/// Heights over a grid, drawn as a net. NaN is a hole.
struct Surface {
  std::string label;
  std::vector<double> x, y;  ///< grid lines, two or more each
  std::vector<double> z;     ///< z[j * x.size() + i] at (x[i], y[j])
  Color color = Color::automatic;
};

/// Holds curves, or surfaces: not both.
struct Panel {
  std::string title, x_label, y_label;
  std::vector<Curve> curves;  ///< later ones lie over earlier ones: bands first
  bool equal_axes = false;    ///< a metre is as long in x as in y
  std::optional<std::pair<double, double>> x_range = {}, y_range = {};  ///< else what the curves need
  bool log_y = false;                                                   ///< what is not positive is a gap
  std::vector<Surface> surfaces = {};
  std::string z_label = {};
  std::vector<std::string> y_names = {};  ///< of y = 0, 1, ...; in place of the numbers
};

struct Plot {
  std::string id;     ///< `fig-3.4`: letters, digits, `-`, `.` and `_`, as it names files
  std::string title;  ///< over all panels; may be empty
  int columns = 1;    ///< panels per row; they fill row by row
  std::vector<Panel> panels;
};

/// A curve of the outlines of covariance ellipses, so many sigmas large. `means` and `covariances` are as
/// long.
Curve ellipses(std::string label, const std::vector<Eigen::Vector2d>& means,
               const std::vector<Eigen::Matrix2d>& covariances, double sigmas = 2);

/// A curve of y at x = 0, 1, 2, ... as steps of a filter are counted, from `first` on.
Curve over_steps(std::string label, std::vector<double> y, Style style = Style::line, double first = 0);

/// Writes three files, the same bytes for the same plot: `figures/ID.csv` with every number (a row per point:
/// panel and curve count from 1, column `y2_or_z` is the band's other edge or the surface's height), the
/// gnuplot script `figures/ID.gp` that reads it (`gnuplot figures/ID.gp` in `out` draws again), and
/// `figures/ID.svg`.
///
/// Without gnuplot, or when it complains, table and script stay and `warnings` (unless null) says so, once.
/// Throws std::invalid_argument where lengths do not fit or the id names no file, RecordError when the disk
/// refuses.
LedgerFigure draw_plot(const std::filesystem::path& out, const Plot& plot,
                       std::vector<std::string>* warnings);

}  // namespace incognita
