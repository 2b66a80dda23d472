#include "incognita/vision/corners.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/vision/pattern.hpp"

namespace incognita {
namespace {

/// Mean gradient product's smaller eigenvalue, from its definition with Sobel's gradient.
double naive_strength(const Image& image, int u, int v, int window) {
  double xx = 0, xy = 0, yy = 0;
  for (int r = v - window / 2; r <= v + window / 2; ++r)
    for (int c = u - window / 2; c <= u + window / 2; ++c) {
      double gx = 0, gy = 0;
      for (int k = -1; k <= 1; ++k) {
        const double weight = (k == 0 ? 2 : 1) / 8.0;
        gx += weight * (image(c + 1, r + k) - image(c - 1, r + k));
        gy += weight * (image(c + k, r + 1) - image(c + k, r - 1));
      }
      xx += gx * gx;
      xy += gx * gy;
      yy += gy * gy;
    }
  return ((xx + yy) / 2 - std::sqrt((xx - yy) * (xx - yy) / 4 + xy * xy)) / (window * window);
}

void draw_square(Image& image, int u0, int v0, int side, std::uint8_t grey) {
  for (int v = v0; v < v0 + side; ++v)
    for (int u = u0; u < u0 + side; ++u) image(u, v) = grey;
}

TEST(StrongestCorner, FindsADrawnCornerInItsBoxOnly) {
  Image image(200, 150, 60);
  draw_square(image, 50, 40, 40, 110);   // its first corner is at (50, 40)
  draw_square(image, 130, 90, 40, 250);  // a much stronger one, elsewhere
  const PixelBox box{35, 25, 30, 30};
  const auto corner = strongest_corner(image, box, 11);
  ASSERT_TRUE(corner);
  EXPECT_NEAR(corner->u, 50, 4);
  EXPECT_NEAR(corner->v, 40, 4);
  const auto stronger = strongest_corner(image, {0, 0, 200, 150}, 11);
  ASSERT_TRUE(stronger);
  EXPECT_GT(stronger->strength, 4 * corner->strength);
  EXPECT_GT(stronger->u, 120);
}

TEST(StrongestCorner, IsTheBestOfTheBoxByDefinition) {
  const Image image = Pattern(1, 35).drawn(160, 120);
  for (const PixelBox& box : {PixelBox{40, 30, 40, 30}, PixelBox{70, 55, 1, 1}, PixelBox{20, 60, 15, 40}}) {
    const auto corner = strongest_corner(image, box, 11);
    ASSERT_TRUE(corner);
    EXPECT_TRUE(corner->u >= box.u && corner->u < box.u + box.width);
    EXPECT_TRUE(corner->v >= box.v && corner->v < box.v + box.height);
    double best = 0;
    for (int v = box.v; v < box.v + box.height; ++v)
      for (int u = box.u; u < box.u + box.width; ++u) best = std::max(best, naive_strength(image, u, v, 11));
    EXPECT_NEAR(corner->strength, best, 1e-3 * best);
    EXPECT_NEAR(naive_strength(image, corner->u, corner->v, 11), best, 1e-3 * best);
  }
}

TEST(StrongestCorner, AnEdgeIsNone) {
  Image image(200, 150, 60);
  for (int v = 0; v < 150; ++v)
    for (int u = 100; u < 200; ++u) image(u, v) = 200;
  const auto corner = strongest_corner(image, {80, 50, 40, 40}, 11);
  ASSERT_TRUE(corner);
  EXPECT_LT(corner->strength, 1);
}

TEST(StrongestCorner, TheBoxMayLeaveTheImage) {
  const Image image = Pattern(2, 35).drawn(160, 120);
  for (const PixelBox& box : {PixelBox{-20, -20, 40, 40}, PixelBox{150, 110, 40, 40}}) {
    const auto corner = strongest_corner(image, box, 11);
    ASSERT_TRUE(corner);
    EXPECT_TRUE(corner->u >= 0 && corner->u < 160 && corner->v >= 0 && corner->v < 120);
  }
  EXPECT_FALSE(strongest_corner(image, {160, 0, 40, 40}, 11));
  EXPECT_FALSE(strongest_corner(image, {-50, 0, 40, 40}, 11));
  EXPECT_FALSE(strongest_corner(image, {50, 50, 0, 40}, 11));
}

}  // namespace
}  // namespace incognita
