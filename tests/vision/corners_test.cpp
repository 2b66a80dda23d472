#include "incognita/vision/corners.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/vision/pattern.hpp"

namespace incognita {
namespace {

/// Smaller eigenvalue of the mean gradient product, from its definition with Sobel gradients.
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

void draw_square(Image& image, int u0, int v0, int side, std::uint8_t gray) {
  for (int v = v0; v < v0 + side; ++v)
    for (int u = u0; u < u0 + side; ++u) image(u, v) = gray;
}

TEST(StrongestCorner, FindsADrawnCornerInsideItsBoxOnly) {
  Image image(200, 150, 60);
  draw_square(image, 50, 40, 40, 110);   // its first corner is at (50, 40)
  draw_square(image, 130, 90, 40, 250);  // a much stronger one, outside the box
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

TEST(StrongestCorner, MaximizesTheStrengthInTheBox) {
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

TEST(StrongestCorner, AnEdgeIsNotACorner) {
  Image image(200, 150, 60);
  for (int v = 0; v < 150; ++v)
    for (int u = 100; u < 200; ++u) image(u, v) = 200;
  const auto corner = strongest_corner(image, {80, 50, 40, 40}, 11);
  ASSERT_TRUE(corner);
  EXPECT_LT(corner->strength, 1);
}

TEST(StrongestCorner, TheBoxMayExtendBeyondTheImage) {
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

/// A dark lower right quarter plane from (u, v) on, averaged over pixels, then blurred as by a lens.
Image quarter_plane(double u0, double v0) {
  const auto sharp = [&](int u, int v) {
    const double in_u = std::clamp(u + 0.5 - u0, 0.0, 1.0), in_v = std::clamp(v + 0.5 - v0, 0.0, 1.0);
    return 200 - 150 * in_u * in_v;
  };
  Image image(60, 50);
  for (int v = 0; v < 50; ++v)
    for (int u = 0; u < 60; ++u) {
      double sum = 0;
      for (int dv = -1; dv <= 1; ++dv)
        for (int du = -1; du <= 1; ++du)
          sum += (2 - std::abs(du)) * (2 - std::abs(dv)) * sharp(u + du, v + dv);
      image(u, v) = static_cast<std::uint8_t>(std::lround(sum / 16));
    }
  return image;
}

TEST(CenterOfCorner, IsTheIntersectionOfTheEdges) {
  for (const double fraction : {0.0, 0.2, 0.5, 0.8}) {
    const Eigen::Vector2d corner(30 + fraction, 25 - fraction);
    const Image image = quarter_plane(corner.x(), corner.y());
    const Eigen::Vector2d starts[] = {{30, 25}, {33, 27}, {28, 24}};
    for (const Eigen::Vector2d& start : starts) {
      const auto all = center_of_corner(image, start, 11), rounded = center_of_corner(image, start, 11, 5);
      ASSERT_TRUE(all && rounded);
      EXPECT_LT((*all - corner).norm(), 0.3);
      EXPECT_LT((*rounded - corner).norm(), 0.1) << rounded->transpose() << " not " << corner.transpose();
    }
  }
}

TEST(CenterOfCorner, IsUndefinedInAUniformImage) {
  EXPECT_FALSE(center_of_corner(Image(60, 50, 128), {30, 25}, 11));
}

}  // namespace
}  // namespace incognita
