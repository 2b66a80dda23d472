// Curves of figures, from what they are drawn of.
#pragma once

#include <functional>
#include <string>

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

}  // namespace incognita
