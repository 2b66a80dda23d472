#include "incognita/control/path_speed.hpp"

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

/// In each piece the speed, squared, is of fourth order in time: at most two peaks, which eight slices tell
/// apart and a bracketing search then finds.
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

}  // namespace

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
