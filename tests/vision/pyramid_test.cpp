#include "incognita/vision/pyramid.hpp"

#include <gtest/gtest.h>

#include "incognita/vision/small_image.hpp"
#include "tests/vision/pattern.hpp"

namespace incognita {
namespace {

TEST(ImagePyramid, OutlivesTheOneItWasCopiedFrom) {
  const Image image(320, 240, 77);
  ImagePyramid copied, assigned;
  {
    const ImagePyramid original(image);
    copied = ImagePyramid(original);
    assigned = original;
    EXPECT_NE(&copied.image(1), &original.image(1));
  }
  for (const ImagePyramid* pyramid : {&copied, &assigned}) {
    EXPECT_EQ(&pyramid->image(0), &image);
    EXPECT_EQ(pyramid->image(1).width(), 160);
    EXPECT_EQ(pyramid->image(2)(10, 10), 77);
    EXPECT_EQ(pyramid->summed(1).over(0, 0, 3).sum, 9 * 77);
  }
}

TEST(ImagePyramid, EachLevelIsHalfOfTheOneBefore) {
  const Image image(321, 240, 77);
  const ImagePyramid pyramid(image);
  ASSERT_EQ(pyramid.levels(), 3) << "the fourth would be less than 48 px high";
  EXPECT_EQ(&pyramid.image(0), &image);
  EXPECT_EQ(pyramid.image(1).width(), 161);
  EXPECT_EQ(pyramid.image(1).height(), 120);
  EXPECT_EQ(pyramid.image(2).height(), 60);
  EXPECT_EQ(pyramid.image(2)(10, 10), 77);
  EXPECT_EQ(ImagePyramid(image, 2).levels(), 2);
}

/// A dark square keeps its place: pixel (u, v) lies at (u, v) / 2^level.
TEST(ImagePyramid, PositionsScale) {
  Image image(320, 240, 200);
  for (int v = 100; v <= 108; ++v)
    for (int u = 160; u <= 168; ++u) image(u, v) = 20;
  const ImagePyramid pyramid(image);
  const Image& half = pyramid.image(1);
  double sum = 0, at_u = 0, at_v = 0;
  for (int v = 0; v < half.height(); ++v)
    for (int u = 0; u < half.width(); ++u) {
      const double dark = 200 - half(u, v);
      sum += dark, at_u += dark * u, at_v += dark * v;
    }
  EXPECT_NEAR(at_u / sum, at_level({164, 104}, 1).x(), 0.05);
  EXPECT_NEAR(at_v / sum, at_level({164, 104}, 1).y(), 0.05);
}

TEST(SmallImage, HasZeroMeanAndUnitVariance) {
  SmallImage small;
  small.assign(Pattern(3, 30).drawn(640, 480));
  EXPECT_LE(small.width(), SmallImage::max_width);
  double sum = 0, squares = 0;
  for (int v = 0; v < small.height(); ++v)
    for (int u = 0; u < small.width(); ++u) sum += small(u, v), squares += small(u, v) * small(u, v);
  const double pixels = small.width() * small.height();
  EXPECT_NEAR(sum / pixels, 0, 1e-3);
  EXPECT_NEAR(squares / pixels, 1, 1e-3);
  EXPECT_TRUE(small.from_image(small.to_image(7, 5)).isApprox(Eigen::Vector2d(7, 5)));
  EXPECT_FALSE(small.sample({-0.5, 3}));
  small.assign(Image(640, 480, 90));
  EXPECT_EQ(small(3, 3), 0) << "no contrast";
}

}  // namespace
}  // namespace incognita
