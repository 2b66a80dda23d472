#include "incognita/slam/features/automatic_settings.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace incognita {
namespace {

/// Between the rays through two pixels, rad; half a turn if one of them is none.
double angle(const Camera& camera, const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  const auto a = camera.unproject(from), b = camera.unproject(to);
  if (!a || !b) return std::numbers::pi;
  return std::atan2(a->cross(*b).norm(), a->dot(*b));
}

}  // namespace

CameraSlamSettings with_automatic(CameraSlamSettings settings, const Camera& camera) {
  // Corners about 70 pixels apart at 640x480. The fewest and the most were not varied in an experiment
  constexpr double at_vga = 60, vga_px = 640.0 * 480.0, fewest = 30, most = 80;
  int& wanted = settings.map.wanted_visible;
  const double share = std::sqrt(static_cast<double>(camera.width()) * camera.height() / vga_px);
  if (wanted == 0)
    wanted = std::min(static_cast<int>(std::lround(std::clamp(at_vga * share, fewest, most))),
                      settings.map.max_landmarks);
  return settings;
}

int most_searched(const CameraSlamSettings& settings) {
  return settings.search.max_measurements > 0 ? settings.search.max_measurements
                                              : settings.map.wanted_visible;
}

int most_in_view(const CameraSlamSettings& settings, const Camera& camera) {
  // In map-room with gaps of 0.6 m, seeds 2 and 4: 98 and 109 in nine of ten frames, at most 129
  constexpr double per_gap = 2.8, prior_depths = 1.5;
  const double gap_m = settings.map.max_gap_m;
  if (gap_m == 0) return most_searched(settings);
  const double u = camera.width() / 2.0, v = camera.height() / 2.0;
  const double distance_m = prior_depths / settings.initialization.inverse_depth_per_m;
  const double gaps =
      angle(camera, {0, v}, {2 * u, v}) * angle(camera, {u, 0}, {u, 2 * v}) * std::pow(distance_m / gap_m, 2);
  return std::max(most_searched(settings), static_cast<int>(std::min(per_gap * gaps, 1e4)));
}

int affordable_measurements(const SearchSettings& settings, int errors) {
  // Rounded from the stage times of recorded runs at 640x480 on one core of a server: search, planes and consensus of a
  // feature; an update of two rows takes 2 errors^2 operations on one triangle
  constexpr double feature_ms = 0.06, operations_per_ms = 20e6;
  constexpr int fewest = 10;
  const double update_ms = 2.0 * errors * errors / operations_per_ms;
  return std::max(fewest, static_cast<int>(settings.budget_ms / (feature_ms + update_ms)));
}

}  // namespace incognita
