// Cheap camera noise: normals are drawn once and read from a random offset for every row.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "incognita/math/random.hpp"
#include "incognita/vision/image.hpp"

namespace incognita {

class StateArchive;

class ImageNoise {
 public:
  /// `name`: of its random stream, one per camera. Throws std::invalid_argument if sigma_gray is negative or above 100.
  ImageNoise(double sigma_gray, std::uint64_t seed, const std::string& name = "sensor.image");

  /// Adds noise to every pixel and clamps it to 0 to 255.
  void add_to(Image& image);

  /// Saves or restores the noise that is still to come: math/saved_state/.
  void state(StateArchive& archive);

 private:
  RandomStream random_;
  std::vector<std::int16_t> table_;  ///< gray levels; empty without noise
};

}  // namespace incognita
