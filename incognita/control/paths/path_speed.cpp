#include "incognita/control/paths/path_speed.hpp"

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <sstream>

namespace incognita {
namespace {

PathSpeed fastest(const PointPath&) { return {}; }

PathSpeed fastest(const CirclePath& path) { return {path.radius_m * std::abs(path.rate_rad_s), 0}; }

/// amplitude (2 cos 2t - 2/pi) is largest where cos 2t = -1
PathSpeed fastest(const BackAndForthPath& path) {
  constexpr double pi = std::numbers::pi;
  return {path.radius_m * std::abs(path.amplitude_rad) * (2 + 2 / pi), pi / 2};
}

PathSpeed fastest(const WayPointPath& path) {
  for (std::size_t leg = 0; leg + 1 < path.points.size(); ++leg) {
    const Path first =
        WayPointPath{{path.points.begin(), path.points.begin() + static_cast<long>(leg) + 2}, path.speed_m_s};
    const double way = (path.points[leg + 1] - path.points[leg]).norm();
    if (way > 0) return {path.speed_m_s, span_of(first).end_s / 2};
  }
  return {};
}

/// Within each piece the squared speed is a quartic in time with at most two peaks; eight slices separate
/// them and a bracketing search refines the best.
PathSpeed fastest(const SampledPath& path) {
  constexpr int slices = 8, digits = 40, most_steps = 60;
  const PoseSpline& spline = path.spline;
  const auto slowness = [&](double t) { return -at(spline, t).rate.head<3>().norm(); };
  PathSpeed best;
  for (Eigen::Index i = 0; i + 1 < spline.t.size(); ++i) {
    const double start = spline.t[i], slice = (spline.t[i + 1] - start) / slices;
    for (int k = 0; k <= slices; ++k) {
      const double t = start + slice * k;
      if (-slowness(t) > best.m_s * (1 + 1e-12)) best = {-slowness(t), t};
    }
  }
  const auto piece = std::upper_bound(spline.t.begin() + 1, spline.t.end() - 1, best.t_s) - spline.t.begin();
  const double slice = (spline.t[piece] - spline.t[piece - 1]) / slices;
  std::uintmax_t steps = most_steps;
  const auto [t, negative] = boost::math::tools::brent_find_minima(
      slowness, std::max(best.t_s - slice, spline.t[0]),
      std::min(best.t_s + slice, spline.t[spline.t.size() - 1]), digits, steps);
  return -negative > best.m_s ? PathSpeed{-negative, t} : best;
}

PathAcceleration strongest(const PointPath&) { return {}; }

PathAcceleration strongest(const CirclePath& path) {
  return {path.radius_m * path.rate_rad_s * path.rate_rad_s, 0};
}

/// The path repeats every pi seconds up to a rotation, so over time the largest acceleration points along an axis.
PathAcceleration strongest(const BackAndForthPath& path) {
  constexpr int slices = 1000;
  PathAcceleration most;
  for (int i = 0; i <= slices; ++i) {
    const Reference r = at(Path(path), std::numbers::pi * i / slices);
    most.m_s2 = std::max(most.m_s2, r.acceleration.norm());
    most.rad_s2 = std::max(most.rad_s2, std::abs(r.heading_acceleration));
  }
  return most;
}

/// A minimum-jerk motion over s in time T has a maximum acceleration of 10/sqrt(3) s/T^2, with T = 15/8 s/speed.
PathAcceleration strongest(const WayPointPath& path) {
  PathAcceleration most;
  for (std::size_t leg = 0; leg + 1 < path.points.size(); ++leg) {
    const Eigen::Vector3d way = path.points[leg + 1] - path.points[leg];
    if (!(way.norm() > 0)) continue;
    const double T = 15.0 / 8 * way.norm() / path.speed_m_s;
    most.m_s2 = std::max(most.m_s2, 10 / std::sqrt(3.0) * way.cwiseAbs().maxCoeff() / (T * T));
  }
  return most;
}

/// The acceleration of a cubic spline is linear between samples, so its maximum is at a sample.
PathAcceleration strongest(const SampledPath& path) {
  return {path.spline.bending.topRows<3>().cwiseAbs().maxCoeff(),
          path.spline.bending.row(3).cwiseAbs().maxCoeff()};
}

}  // namespace

PathAcceleration greatest_acceleration(const Path& path) {
  return std::visit([](const auto& p) { return strongest(p); }, path);
}

PathSpeed greatest_speed(const Path& path) {
  return std::visit([](const auto& p) { return fastest(p); }, path);
}

std::optional<std::string> unreachable(const Path& path, double max_speed_m_s) {
  const PathSpeed asked = greatest_speed(path);
  if (asked.m_s <= max_speed_m_s) return std::nullopt;
  std::ostringstream why;
  why << "the path asks for " << asked.m_s << " m/s at t = " << asked.t_s << " s, the vehicle has "
      << max_speed_m_s << " m/s";
  return why.str();
}

}  // namespace incognita
