// Descriptors of views of the same texture are alike under rotation, brightness and contrast; those of others are not.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "incognita/math/random.hpp"
#include "incognita/vision/descriptor.hpp"

namespace incognita {
namespace {

/// Smooth random texture, defined everywhere.
struct Texture {
  std::array<double, 40> phase{}, u{}, v{};
  explicit Texture(std::uint64_t seed) {
    RandomStream random(seed, "texture");
    for (std::size_t i = 0; i < phase.size(); ++i) {
      phase[i] = random.uniform(0, 6.28);
      u[i] = random.uniform(-0.5, 0.5), v[i] = random.uniform(-0.5, 0.5);
    }
  }
  double operator()(double x, double y) const {
    double sum = 0;
    for (std::size_t i = 0; i < phase.size(); ++i) sum += std::sin(u[i] * x + v[i] * y + phase[i]);
    return 128 + 10 * sum;
  }
};

/// Turned about the middle of the image and scaled.
Image view_of(const Texture& texture, double turn_rad, double scale, double gain = 1, double offset = 0) {
  Image image(61, 61);
  for (int v = 0; v < 61; ++v)
    for (int u = 0; u < 61; ++u) {
      const double x = (u - 30) / scale, y = (v - 30) / scale;
      const double gray = texture(std::cos(turn_rad) * x + std::sin(turn_rad) * y,
                                  -std::sin(turn_rad) * x + std::cos(turn_rad) * y);
      image(u, v) = static_cast<std::uint8_t>(std::clamp(gain * gray + offset, 0.0, 255.0));
    }
  return image;
}

std::vector<Descriptor> described(const Image& image) {
  std::vector<Descriptor> out;
  describe(image, {30, 30}, 2, out);
  return out;
}

struct Nearest {
  int distance = 1 << 30;
  double turn_rad = 0;
};
Nearest nearest(const std::vector<Descriptor>& a, const std::vector<Descriptor>& b) {
  Nearest out;
  for (const Descriptor& one : a)
    for (const Descriptor& other : b)
      if (const int d = squared_distance(one, other); d < out.distance)
        out = {d, other.angle_rad - one.angle_rad};
  return out;
}

constexpr int alike = 250 * 250;

TEST(Descriptor, ToleratesRotationAndTellsIt) {
  int found = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Texture texture(seed);
    const double turn_rad = -3 + 0.3 * static_cast<double>(seed);
    const Nearest near = nearest(described(view_of(texture, 0, 1)), described(view_of(texture, turn_rad, 1)));
    if (near.distance > alike) continue;
    ++found;
    EXPECT_NEAR(std::remainder(near.turn_rad - turn_rad, 2 * 3.14159265358979), 0, 0.1) << seed;
  }
  EXPECT_GE(found, 18);
}

TEST(Descriptor, ToleratesBrightnessContrastAndSomeScale) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Texture texture(seed);
    const auto original = described(view_of(texture, 0, 1));
    EXPECT_LT(nearest(original, described(view_of(texture, 0, 1, 0.5, 20))).distance, alike / 8) << seed;
    EXPECT_LT(nearest(original, described(view_of(texture, 0, 1.2))).distance, 320 * 320) << seed;
  }
}

TEST(Descriptor, DiffersBetweenTextures) {
  for (std::uint64_t seed = 0; seed < 20; ++seed)
    EXPECT_GT(nearest(described(view_of(Texture(seed), 0, 1)), described(view_of(Texture(seed + 100), 0, 1)))
                  .distance,
              330 * 330)
        << seed;
}

TEST(Descriptor, NoneWithoutContrast) { EXPECT_TRUE(described(Image(61, 61, 90)).empty()); }

TEST(Descriptor, IsDefinedAtTheBorder) {
  const Image image = view_of(Texture(3), 0, 1);
  std::vector<Descriptor> out;
  describe(image, {0, 60}, 2, out);
  EXPECT_FALSE(out.empty());
}

}  // namespace
}  // namespace incognita
