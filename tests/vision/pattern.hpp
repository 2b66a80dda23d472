// A smooth random texture that can be rendered with any subpixel shift.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "incognita/math/random.hpp"
#include "incognita/vision/image.hpp"

namespace incognita {

class Pattern {
 public:
  /// Waves of 6 to 16 pixels in all directions; `contrast` is the standard deviation in gray levels.
  Pattern(std::uint64_t seed, double contrast) {
    RandomStream random(seed, "pattern");
    constexpr int count = 16;
    for (int i = 0; i < count; ++i) {
      const double turn = random.uniform(0, 2 * M_PI), k = 2 * M_PI / random.uniform(6, 16);
      waves_.push_back({k * std::cos(turn), k * std::sin(turn), random.uniform(0, 2 * M_PI)});
    }
    amplitude_ = contrast * std::sqrt(2.0 / count);
  }

  double operator()(double u, double v) const {
    double sum = 0;
    for (const Wave& w : waves_) sum += std::cos(w.ku * u + w.kv * v + w.phase);
    return amplitude_ * sum;
  }

  /// The texture at (u, v) is rendered at (u + du, v + dv), about a mean gray level.
  Image drawn(int width, int height, double du = 0, double dv = 0, double mean = 128) const {
    Image image(width, height);
    for (int v = 0; v < height; ++v)
      for (int u = 0; u < width; ++u)
        image(u, v) =
            static_cast<std::uint8_t>(std::clamp(std::lround(mean + (*this)(u - du, v - dv)), 0l, 255l));
    return image;
  }

 private:
  struct Wave {
    double ku, kv, phase;
  };
  std::vector<Wave> waves_;
  double amplitude_;
};

}  // namespace incognita
