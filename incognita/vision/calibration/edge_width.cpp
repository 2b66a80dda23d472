#include "incognita/vision/calibration/edge_width.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "incognita/vision/calibration/chessboard.hpp"

namespace incognita {
namespace {

constexpr int samples = 61;  // of a profile from center to center of two squares
constexpr int end = 9;       // samples at either end that give the levels of black and white

/// Share of the profile between the last crossing of 10 % and the first one of 90 %.
double rise(const std::array<double, samples>& profile) {
  double low = 0, high = 0;
  for (int i = 0; i < end; ++i)
    low += profile[static_cast<std::size_t>(i)] / end,
        high += profile[samples - 1 - static_cast<std::size_t>(i)] / end;
  const auto crossing =
      [&](double share) {  // from the middle outwards, so that noise at the ends does not count
        const auto level = [&](int i) {
          return (profile[static_cast<std::size_t>(i)] - low) / (high - low) - share;
        };
        const int step = share < 0.5 ? -1 : 1;
        int i = samples / 2;
        while (i + step >= 0 && i + step < samples && (share < 0.5 ? level(i) > 0 : level(i) < 0)) i += step;
        const double here = level(i), before = level(i - step);
        return here != before ? i - step * std::clamp(here / (here - before), 0.0, 1.0) : i;
      };
  if (std::abs(high - low) < 1) return 1;
  return (crossing(0.9) - crossing(0.1)) / (samples - 1);
}

/// Width of the edge from corner `a` to `b`, whose squares have their centers half of `across` on either side.
double width_of(const Image& image, const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                const Eigen::Vector2d& across) {
  const Eigen::Vector2d middle = (a + b) / 2, along = b - a;
  std::array<double, samples> profile{};
  for (int i = 0; i < samples; ++i)
    for (const double aside : {-0.15, 0.0, 0.15}) {
      const Eigen::Vector2d at = middle + (i / (samples - 1.0) - 0.5) * across + aside * along;
      profile[static_cast<std::size_t>(i)] += image.sample(at.x(), at.y()) / 3;
    }
  const double perpendicular = std::abs(across.x() * along.y() - across.y() * along.x()) / along.norm();
  return rise(profile) * perpendicular;
}

}  // namespace

double edge_width_px(const Image& image, const std::vector<Eigen::Vector2d>& corners,
                     const BoardSize& board) {
  const auto at = [&](int row, int column) -> const Eigen::Vector2d& {
    return corners[static_cast<std::size_t>(row * board.columns + column)];
  };
  double in_rows = 0, in_columns = 0;
  for (int r = 0; r < board.rows; ++r)
    for (int c = 0; c < board.columns; ++c) {
      const Eigen::Vector2d down = r + 1 < board.rows ? at(r + 1, c) - at(r, c) : at(r, c) - at(r - 1, c);
      const Eigen::Vector2d right = c + 1 < board.columns ? at(r, c + 1) - at(r, c) : at(r, c) - at(r, c - 1);
      if (c + 1 < board.columns) in_rows += width_of(image, at(r, c), at(r, c + 1), down);
      if (r + 1 < board.rows) in_columns += width_of(image, at(r, c), at(r + 1, c), right);
    }
  return std::max(in_rows / (board.rows * (board.columns - 1)),
                  in_columns / (board.columns * (board.rows - 1)));
}

}  // namespace incognita
