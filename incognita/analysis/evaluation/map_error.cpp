#include "incognita/analysis/evaluation/map_error.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace incognita {

Eigen::Vector2d PlanarFit::operator()(const Eigen::Vector2d& p) const {
  const double c = std::cos(turn_rad), s = std::sin(turn_rad);
  return Eigen::Vector2d(c * p.x() - s * p.y(), s * p.x() + c * p.y()) + shift;
}

PlanarFit fit_rigid(const std::vector<Eigen::Vector2d>& from, const std::vector<Eigen::Vector2d>& to) {
  if (from.size() != to.size())
    throw std::invalid_argument("fit_rigid: the lists of points must have equal length");
  PlanarFit fit;
  if (from.empty()) return fit;
  Eigen::Vector2d from_mean = Eigen::Vector2d::Zero(), to_mean = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < from.size(); ++i) from_mean += from[i], to_mean += to[i];
  from_mean /= static_cast<double>(from.size());
  to_mean /= static_cast<double>(from.size());
  // Sums of inner and cross products: proportional to cosine and sine of the rotation
  double along = 0, across = 0;
  for (std::size_t i = 0; i < from.size(); ++i) {
    const Eigen::Vector2d a = from[i] - from_mean, b = to[i] - to_mean;
    along += a.dot(b);
    across += a.x() * b.y() - a.y() * b.x();
  }
  fit.turn_rad = std::atan2(across, along);
  fit.shift = to_mean - fit(from_mean);
  return fit;
}

MapError map_error(const std::vector<Eigen::Vector2d>& estimated,
                   const std::vector<Eigen::Vector2d>& surveyed, double max_distance_m) {
  std::vector<MapError::Match> pairs;
  for (std::size_t e = 0; e < estimated.size(); ++e)
    for (std::size_t s = 0; s < surveyed.size(); ++s) {
      const double distance = (estimated[e] - surveyed[s]).norm();
      if (distance <= max_distance_m) pairs.push_back({e, s, distance});
    }
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const auto& a, const auto& b) { return a.distance_m < b.distance_m; });
  std::vector<bool> used(estimated.size()), taken(surveyed.size()), near(estimated.size());
  MapError error;
  double sum = 0;
  for (const MapError::Match& pair : pairs) {
    near[pair.estimated] = true;
    if (used[pair.estimated] || taken[pair.surveyed]) continue;
    used[pair.estimated] = taken[pair.surveyed] = true;
    error.matches.push_back(pair);
    sum += pair.distance_m * pair.distance_m;
  }
  for (std::size_t e = 0; e < estimated.size(); ++e)
    if (!used[e]) (near[e] ? error.twice : error.unmatched).push_back(e);
  for (std::size_t s = 0; s < surveyed.size(); ++s)
    if (!taken[s]) error.missing.push_back(s);
  error.rms_m = error.matches.empty() ? std::numeric_limits<double>::quiet_NaN()
                                      : std::sqrt(sum / static_cast<double>(error.matches.size()));
  return error;
}

FittedMapError fitted_map_error(const std::vector<Eigen::Vector2d>& estimated,
                                const std::vector<Eigen::Vector2d>& surveyed, double max_distance_m,
                                const PlanarFit& guess) {
  FittedMapError out{guess, {}};
  const auto match = [&] {
    std::vector<Eigen::Vector2d> moved;
    for (const Eigen::Vector2d& p : estimated) moved.push_back(out.fit(p));
    return map_error(moved, surveyed, max_distance_m);
  };
  out.error = match();
  constexpr int most = 20;
  for (int i = 0; i < most; ++i) {
    std::vector<Eigen::Vector2d> from, to;
    for (const MapError::Match& m : out.error.matches) {
      from.push_back(estimated[m.estimated]);
      to.push_back(surveyed[m.surveyed]);
    }
    if (from.empty()) return out;
    const double before = out.error.rms_m;
    out.fit = fit_rigid(from, to);
    out.error = match();
    if (std::abs(out.error.rms_m - before) <= 1e-12) return out;
  }
  return out;
}

}  // namespace incognita
