#include "incognita/world/rendered/proximity_ring.hpp"

#include <algorithm>
#include <stdexcept>

namespace incognita {

ProximityRing::ProximityRing(const RoomLayout& layout, const RangeRing& ring, std::uint64_t seed)
    : plan_(layout), ring_(ring), noise_(seed, "vehicle.ranges") {}

void ProximityRing::measure(const std::optional<Truth>& truth, std::size_t which, const Tick&,
                            BodyObservation& observation) {
  const SmallVector& vehicle = truth_of(truth, which).carrier;
  if (vehicle.size() == 0)
    throw std::invalid_argument("a proximity ring needs a vehicle that carries the camera");
  observation.proximity_ranges = measure_ranges(plan_, ring_, vehicle.head<2>(), vehicle[2]);
  for (ConeRange& cone : observation.proximity_ranges)
    if (cone.range_m < ring_.reach_m)
      cone.range_m = std::clamp(cone.range_m + ring_.sigma_m * noise_.normal(), 0.0, ring_.reach_m);
}

}  // namespace incognita
