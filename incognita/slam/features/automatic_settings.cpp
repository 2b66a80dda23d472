#include "incognita/slam/features/automatic_settings.hpp"

#include <algorithm>
#include <cmath>

namespace incognita {

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
  // In map-room, seed 2, 82 landmarks in 48 squares of 45 px, and 139 in 70 of 35 px
  constexpr int per_square = 2;
  const int gap_px = settings.map.max_gap_px;
  if (gap_px == 0) return most_searched(settings);
  const auto squares = [gap_px](int side_px) { return (side_px + gap_px - 1) / gap_px; };
  return std::max(most_searched(settings), per_square * squares(camera.width()) * squares(camera.height()));
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
