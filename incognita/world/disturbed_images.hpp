// A sensor set whose images a person disturbs: covered lenses, noise, another light.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "incognita/messages/intervention.hpp"
#include "incognita/world/image_noise.hpp"
#include "incognita/world/world.hpp"

namespace incognita {

/// Until the first disturbance, the observations are those of the sensors behind it.
class DisturbedImages final : public Sensor {
 public:
  DisturbedImages(std::unique_ptr<Sensor> sensors, std::uint64_t seed);

  void cover(const CoverLens& cover) { covered_ = cover.covered; }
  /// Throws std::invalid_argument unless 0 <= sigma_gray <= 100.
  void add_noise(const AddImageNoise& noise);
  /// Throws std::invalid_argument unless 0 <= factor <= 10.
  void change_light(const ChangeLight& light);

  Observation measure(const std::optional<Truth>& truth, const Tick& tick) override;
  void state(StateArchive& archive) override;

 private:
  std::shared_ptr<const Image> disturbed(const Image& image);

  std::unique_ptr<Sensor> sensors_;
  std::uint64_t seed_;
  bool covered_ = false;
  double light_ = 1;
  std::optional<ImageNoise> noise_;
  double sigma_gray_ = 0;  ///< of that noise
};

}  // namespace incognita
