#include "incognita/vision/calibration/coverage.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace incognita {
namespace {

/// Cell of a pixel coordinate; the first pixel begins at -0.5.
int cell_of(double at, int size, int cells) {
  return std::clamp(static_cast<int>(std::floor((at + 0.5) / size * cells)), 0, cells - 1);
}

}  // namespace

void Coverage::add(const std::vector<Eigen::Vector2d>& corners) {
  for (const Eigen::Vector2d& corner : corners) {
    const int row = cell_of(corner.y(), height_px_, rows), column = cell_of(corner.x(), width_px_, columns);
    ++counts_[static_cast<std::size_t>(row * columns + column)];
  }
}

double Coverage::share() const {
  const auto empty = std::count(counts_.begin(), counts_.end(), 0);
  return 1 - static_cast<double>(empty) / static_cast<double>(counts_.size());
}

std::string Coverage::grid() const {
  std::string text;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      char cell[16];
      std::snprintf(cell, sizeof cell, count(row, column) > 0 ? "%5d" : "    .", count(row, column));
      text += cell;
    }
    text += '\n';
  }
  return text;
}

std::string Coverage::gaps() const {
  static constexpr const char* names[3][3] = {{"upper left", "top", "upper right"},
                                              {"left", "center", "right"},
                                              {"lower left", "bottom", "lower right"}};
  // Thirds of the image: 2 of 6 rows each; 3, 2 and 3 of 8 columns
  static constexpr int column_begins[] = {0, 3, 5, columns};
  std::string text;
  for (int v = 0; v < 3; ++v)
    for (int u = 0; u < 3; ++u) {
      int filled = 0, cells = 0;
      for (int row = 2 * v; row < 2 * v + 2; ++row)
        for (int column = column_begins[u]; column < column_begins[u + 1]; ++column, ++cells)
          filled += count(row, column) > 0 ? 1 : 0;
      if (2 * filled < cells) text += (text.empty() ? "" : ", ") + std::string(names[v][u]);
    }
  return text;
}

}  // namespace incognita
