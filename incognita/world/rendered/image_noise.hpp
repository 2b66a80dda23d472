// Camera noise that costs little: normals are drawn once and read from a random place for every row.
#pragma once

#include <cstdint>
#include <vector>

#include "incognita/math/random.hpp"
#include "incognita/vision/image.hpp"

namespace incognita {

class ImageNoise {
 public:
  /// Throws std::invalid_argument when sigma_gray is negative or above 100.
  ImageNoise(double sigma_gray, std::uint64_t seed);

  /// Adds to every pixel and keeps it within 0 to 255.
  void add_to(Image& image);

 private:
  RandomStream random_;
  std::vector<std::int16_t> table_;  ///< grey levels; empty when there is no noise
};

}  // namespace incognita
