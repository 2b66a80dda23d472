#include "incognita/vision/patch.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "incognita/math/random.hpp"
#include "incognita/vision/align_patch.hpp"
#include "tests/vision/painted_plane.hpp"
#include "tests/vision/pattern.hpp"

namespace incognita {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

TEST(Warp, IdentityKeepsThePixels) {
  const Image image = Pattern(1, 35).drawn(60, 50);
  for (const int size : {9, 11, 15}) {
    const int half = size / 2;
    const auto texture = cut_texture(image, Vector2d(30, 20), 21, half);
    ASSERT_TRUE(texture);
    const auto patch = warp(*texture, Matrix2d::Identity(), size);
    ASSERT_TRUE(patch);
    EXPECT_EQ(patch->size, size);
    double mean = 0, squares = 0;
    for (int r = 0; r < size; ++r)
      for (int c = 0; c < size; ++c) mean += image(30 - half + c, 20 - half + r) / double(size * size);
    for (int r = 0; r < max_patch_size; ++r)
      for (int c = 0; c < PatchTemplate::row_stride; ++c) {
        const int value = patch->values[r * PatchTemplate::row_stride + c];
        squares += double(value) * value;
        if (r < size && c < size)
          EXPECT_NEAR(value, 8 * (image(30 - half + c, 20 - half + r) - mean), 1);
        else
          EXPECT_EQ(value, 0);
      }
    EXPECT_NEAR(patch->norm, std::sqrt(squares), 1e-3 * patch->norm);
  }
}

TEST(Warp, AQuarterTurnRotatesThePixels) {
  const Image image = Pattern(2, 35).drawn(60, 50);
  const auto texture = cut_texture(image, Vector2d(30, 20), 21, 5);
  Matrix2d turn;
  turn << 0, -1, 1, 0;
  const auto upright = warp(*texture, Matrix2d::Identity(), 11), turned = warp(*texture, turn, 11);
  ASSERT_TRUE(upright && turned);
  constexpr int stride = PatchTemplate::row_stride;
  for (int dv = -5; dv <= 5; ++dv)
    for (int du = -5; du <= 5; ++du)
      EXPECT_EQ(turned->values[(dv + 5) * stride + du + 5], upright->values[(du + 5) * stride - dv + 5]);
}

TEST(Warp, FailsBeyondTheStoredTexture) {
  const Image image = Pattern(3, 35).drawn(60, 50);
  const auto texture = cut_texture(image, Vector2d(30, 20), 15, 5);
  EXPECT_TRUE(warp(*texture, 1.4 * Matrix2d::Identity(), 11));
  EXPECT_FALSE(warp(*texture, 1.6 * Matrix2d::Identity(), 11));
}

TEST(Warp, FailsForAUniformPatch) {
  const auto texture = cut_texture(Image(60, 50, 77), Vector2d(30, 20), 15, 5);
  ASSERT_TRUE(texture);
  EXPECT_FALSE(warp(*texture, Matrix2d::Identity(), 11));
}

TEST(Warp, FailsIfItIsNotFinite) {
  const auto texture = cut_texture(Pattern(3, 35).drawn(60, 50), Vector2d(30, 20), 15, 5);
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double scale : {1e10, 1e300, nan, -nan})
    EXPECT_FALSE(warp(*texture, scale * Matrix2d::Identity(), 11)) << scale;
}

/// Rms distance, px, at which the warped patch aligns with another view of a corner, whose edges are turned by about `angle_rad`.
double distance_from_corner(const Matrix2d& texture_from_view, double angle_rad) {
  RandomStream random(4, "corners");
  const auto anywhere = [&] { return Vector2d(random.uniform(29.5, 30.5), random.uniform(29.5, 30.5)); };
  constexpr int count = 40;
  double squares = 0;
  for (int i = 0; i < count; ++i) {
    const Vector2d then = anywhere(), now = anywhere();
    const DarkCorner corner{angle_rad + random.uniform(-0.15, 0.15)};
    const auto texture = cut_texture(drawn(corner, Matrix2d::Identity(), then), then, 39, 5);
    const Image image = drawn(corner, texture_from_view, now);
    squares += (align_patch(image, *texture, texture_from_view, 11, now).value() - now).squaredNorm();
  }
  return std::sqrt(squares / count);
}

TEST(Warp, ACornerIsFoundWhereItIsInAViewFromFarther) {
  EXPECT_LT(distance_from_corner(2 * Matrix2d::Identity(), 0), 0.02);
}

TEST(Warp, ACornerIsFoundWhereItIsInAnObliqueView) {
  Matrix2d oblique;  // foreshortened along one diagonal
  oblique << 1.7, 0.7, 0.7, 1.7;
  EXPECT_LT(distance_from_corner(oblique, 0.8), 0.03);
}

TEST(CutTexture, KeepsThePositionAtTheImageEdge) {
  const Image image = Pattern(4, 35).drawn(60, 50);
  for (const Vector2d& center :
       {Vector2d(30, 20), Vector2d(5, 5), Vector2d(54, 44), Vector2d(6.3, 43.8), Vector2d(30.4, 5)}) {
    const auto texture = cut_texture(image, center, 21, 5);
    ASSERT_TRUE(texture);
    EXPECT_DOUBLE_EQ(texture->pixels.sample(texture->center.x(), texture->center.y()),
                     image.sample(center.x(), center.y()));
  }
  for (const Vector2d& center : {Vector2d(4, 20), Vector2d(30, 4), Vector2d(55, 20), Vector2d(30, 45)})
    EXPECT_FALSE(cut_texture(image, center, 21, 5)) << center.transpose();
}

}  // namespace
}  // namespace incognita
