#include "experiments/curves.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace incognita {
namespace thinning {
namespace {

bool is_drawn_as_line(const Curve& c) {
  return c.style == Style::line || c.style == Style::dashed || c.style == Style::thin ||
         c.style == Style::band;
}

/// Corners of lines and areas: a band has two for each x.
std::size_t corners(const Curve& c) { return is_drawn_as_line(c) ? c.x.size() + c.y2.size() : 0; }

std::size_t corners(const Plot& plot) {
  std::size_t sum = 0;
  for (const Panel& panel : plot.panels)
    for (const Curve& c : panel.curves) sum += corners(c);
  return sum;
}

struct Range {
  double least = std::numeric_limits<double>::infinity(), most = -least;
  void take(double value) {
    if (std::isfinite(value)) least = std::min(least, value), most = std::max(most, value);
  }
  double length() const { return most > least ? most - least : 1; }
};

/// Coordinates in a panel whose width and height are 1.
class Scale {
 public:
  explicit Scale(const Panel& panel) : log_y_(panel.log_y) {
    Range x, y;
    for (const Curve& c : panel.curves) {
      for (const double value : c.x) x.take(value);
      for (const double value : c.y) y.take(height(value));
      for (const double value : c.y2) y.take(height(value));
    }
    if (panel.x_range) x = {panel.x_range->first, panel.x_range->second};
    if (panel.y_range) y = {height(panel.y_range->first), height(panel.y_range->second)};
    width_ = x.length(), height_ = y.length();
    if (panel.equal_axes) width_ = height_ = std::max(width_, height_);
  }
  Eigen::Vector2d operator()(double x, double y) const { return {x / width_, height(y) / height_}; }

 private:
  double height(double y) const { return log_y_ ? (y > 0 ? std::log10(y) : NAN) : y; }
  bool log_y_;
  double width_ = 1, height_ = 1;
};

double distance(const Eigen::Vector2d& p, const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  const Eigen::Vector2d along = to - from;
  const double squared = along.squaredNorm();
  const double at = squared > 0 ? std::clamp((p - from).dot(along) / squared, 0.0, 1.0) : 0;
  return (p - from - at * along).norm();
}

/// Line simplification by Douglas and Peucker, between gaps.
std::vector<bool> kept(const Curve& c, const Scale& scale, double tolerance) {
  const auto edges = [&](std::size_t i) {
    return std::pair(scale(c.x[i], c.y[i]), scale(c.x[i], c.y2.empty() ? c.y[i] : c.y2[i]));
  };
  const auto is_gap = [&](std::size_t i) {
    const auto [one, other] = edges(i);
    return !one.allFinite() || !other.allFinite();
  };
  std::vector<bool> keep(c.x.size(), false);
  std::vector<std::pair<std::size_t, std::size_t>>
      open;  // first and last are kept, what is between is not yet
  for (std::size_t i = 0, end = 0; i < c.x.size(); i = end) {
    for (end = i; end < c.x.size() && !is_gap(end);) ++end;
    if (end == i) {
      keep[end++] = true;
      continue;
    }
    keep[i] = keep[end - 1] = true;
    open.emplace_back(i, end - 1);
  }
  while (!open.empty()) {
    const auto [first, last] = open.back();
    open.pop_back();
    const auto [one_from, other_from] = edges(first);
    const auto [one_to, other_to] = edges(last);
    double most = tolerance;
    std::size_t farthest = first;
    for (std::size_t i = first + 1; i < last; ++i) {
      const auto [one, other] = edges(i);
      const double off = std::max(distance(one, one_from, one_to), distance(other, other_from, other_to));
      if (off > most) most = off, farthest = i;
    }
    if (farthest == first) continue;
    keep[farthest] = true;
    open.emplace_back(first, farthest);
    open.emplace_back(farthest, last);
  }
  return keep;
}

std::vector<double> only(const std::vector<bool>& keep, const std::vector<double>& values) {
  std::vector<double> some;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (keep[i]) some.push_back(values[i]);
  return some;
}

Plot simplified(Plot plot, double tolerance) {
  for (Panel& panel : plot.panels) {
    const Scale scale(panel);
    for (Curve& c : panel.curves) {
      if (!is_drawn_as_line(c)) continue;
      const std::vector<bool> keep = kept(c, scale, tolerance);
      c.x = only(keep, c.x), c.y = only(keep, c.y), c.y2 = only(keep, c.y2);
    }
  }
  return plot;
}

}  // namespace
}  // namespace thinning

Plot thinned(const Plot& plot, std::size_t most_corners) {
  using namespace thinning;
  constexpr double finest = 2e-4, coarsest = 0.02;  // of a panel; a tenth of a pixel, and ten
  Plot thin = plot;
  for (double tolerance = finest; corners(thin) > most_corners && tolerance < coarsest; tolerance *= 1.5)
    thin = simplified(plot, tolerance);
  return thin;
}

}  // namespace incognita
