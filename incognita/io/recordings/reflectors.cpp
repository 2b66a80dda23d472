#include "incognita/io/recordings/reflectors.hpp"

#include <cmath>
#include <stdexcept>

namespace incognita {
namespace {

/// Adjacent beams, in scan order.
struct Group {
  int beams = 0;
  int last = 0;
  double range_sum_m = 0;
  double index_sum = 0;

  void add(int beam, double range_m) {
    ++beams;
    last = beam;
    range_sum_m += range_m;
    index_sum += beam;
  }
};

void keep(const Group& group, const ReflectorSettings& settings, std::vector<Detection>& found) {
  if (group.beams == 0) return;
  const double range_m = group.range_sum_m / group.beams;
  if (range_m <= settings.nearest_m || range_m >= settings.farthest_m) return;
  const double bearing_rad = settings.first_bearing_rad + settings.step_rad * group.index_sum / group.beams;
  found.push_back({range_m, wrap_angle(bearing_rad), Detection::unknown});
}

}  // namespace

std::vector<Detection> find_reflectors(std::span<const double> ranges_m, std::span<const double> intensities,
                                       const ReflectorSettings& settings) {
  if (ranges_m.size() != intensities.size()) {
    throw std::invalid_argument("find_reflectors: ranges and intensities must have the same size");
  }
  std::vector<Detection> found;
  Group group;
  for (int beam = 0; beam < static_cast<int>(ranges_m.size()); ++beam) {
    const auto i = static_cast<std::size_t>(beam);
    if (!(intensities[i] > 0) || !std::isfinite(ranges_m[i])) continue;
    if (group.beams > 0 && beam - group.last > settings.widest_gap_beams) {
      keep(group, settings, found);
      group = {};
    }
    group.add(beam, ranges_m[i]);
  }
  keep(group, settings, found);
  return found;
}

}  // namespace incognita
