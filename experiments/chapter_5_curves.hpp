// Curves of estimates with their uncertainty, in figures of Chapters 5 and 6.
#pragma once

#include <string>
#include <vector>

#include "experiments/curves.hpp"

namespace incognita {

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

}  // namespace incognita
