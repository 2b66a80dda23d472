// A ring of range sensors about a vehicle in the rendered room, like a ring of sonars.
#pragma once

#include <cstdint>

#include "incognita/math/random.hpp"
#include "incognita/world/rendered/floor_plan.hpp"
#include "incognita/world/sensor_set.hpp"

namespace incognita {

/// Of the vehicle that carries the camera.
class ProximityRing final : public BodySensor {
 public:
  ProximityRing(const RoomLayout& layout, const RangeRing& ring, std::uint64_t seed);

  void measure(const std::optional<Truth>& truth, std::size_t which, const Tick& tick,
               BodyObservation& observation) override;
  void state(StateArchive& archive) override;

 private:
  FloorPlan plan_;
  RangeRing ring_;
  RandomStream noise_;
};

}  // namespace incognita
