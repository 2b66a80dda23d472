// Curves of figures, from what they are drawn of.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "incognita/report/plot.hpp"

namespace incognita {

/// A point for each element: x(element), y(element), or members of it.
template <class Range, class X, class Y>
Curve curve_of(const std::string& label, Style style, Color color, const Range& range, const X& x,
               const Y& y) {
  Curve curve{label, style, {}, {}, {}, color};
  for (const auto& element : range) {
    curve.x.push_back(std::invoke(x, element));
    curve.y.push_back(std::invoke(y, element));
  }
  return curve;
}

/// The coordinates `right` and `up` of points, or of a member of each element.
template <class Range, class Point = std::identity>
Curve path_of(const std::string& label, Style style, Color color, const Range& range, const Point& point = {},
              int right = 0, int up = 1) {
  return curve_of(
      label, style, color, range, [&](const auto& e) { return std::invoke(point, e)[right]; },
      [&](const auto& e) { return std::invoke(point, e)[up]; });
}

/// Filled between edge(element) and its negative.
template <class Range, class X, class Edge>
Curve band_of(const std::string& label, Color color, const Range& range, const X& x, const Edge& edge) {
  Curve band = curve_of(label, Style::band, color, range, x, edge);
  for (const double y : band.y) band.y2.push_back(-y);
  return band;
}

/// Ellipses of 2 sigma about mean(element) by covariance(element), in the coordinates `right` and `up`.
template <class Range, class Mean, class Covariance>
Curve outlines_of(const std::string& label, Color color, const Range& range, const Mean& mean,
                  const Covariance& covariance, int right = 0, int up = 1) {
  std::vector<Eigen::Vector2d> means;
  std::vector<Eigen::Matrix2d> covariances;
  for (const auto& element : range) {
    const auto& center = std::invoke(mean, element);
    means.emplace_back(center[right], center[up]);
    covariances.emplace_back(std::invoke(covariance, element)({right, up}, {right, up}));
  }
  Curve curve = ellipses(label, means, covariances);
  curve.color = color;
  return curve;
}

/// With as many corners of lines and bands as a page of figures can carry, 60 kB of SVG: of longer ones those are left
/// out that the others pass nearest by. A figure with fewer stays as it is.
Plot thinned(const Plot& plot, std::size_t most_corners = 6'000);

/// A panel of curves over time.
inline Panel time_panel(const std::string& title, const std::string& y_label,
                        const std::vector<Curve>& curves = {}) {
  return {title, "t, s", y_label, curves};
}

}  // namespace incognita
