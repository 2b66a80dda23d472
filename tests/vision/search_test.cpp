#include "incognita/vision/search.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "incognita/math/random.hpp"
#include "tests/vision/pattern.hpp"

namespace incognita {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
constexpr int size = 11, half = size / 2;

PatchTemplate patch_at(const Image& image, int u, int v) {
  return warp(*cut_texture(image, Vector2d(u, v), 15, half), Matrix2d::Identity(), size).value();
}

Ellipse circle(const Vector2d& center, double radius) {
  return {center, Matrix2d::Identity() * radius * radius / 9, 3};
}

bool inside(const Ellipse& e, double u, double v) {
  const Vector2d d = Vector2d(u, v) - e.center;
  return d.dot(e.covariance.inverse() * d) <= e.gate_sigmas * e.gate_sigmas;
}

/// Correlation coefficient of two squares, by definition.
double naive(const Image& a, int au, int av, const Image& b, int bu, int bv) {
  double ma = 0, mb = 0, ab = 0, aa = 0, bb = 0;
  for (int r = -half; r <= half; ++r)
    for (int c = -half; c <= half; ++c) {
      ma += a(au + c, av + r);
      mb += b(bu + c, bv + r);
    }
  ma /= size * size;
  mb /= size * size;
  for (int r = -half; r <= half; ++r)
    for (int c = -half; c <= half; ++c) {
      const double x = a(au + c, av + r) - ma, y = b(bu + c, bv + r) - mb;
      ab += x * y;
      aa += x * x;
      bb += y * y;
    }
  return ab / std::sqrt(aa * bb);
}

/// Largest difference from the definition over a region of the image.
double worst_difference(const Image& from, const Image& in, int u, int v) {
  const PatchTemplate patch = patch_at(from, u, v);
  SummedImage summed;
  summed.assign(in);
  CorrelationSheet sheet;
  sheet.start(summed, patch, 0, in.width(), 0, in.height());
  double worst = 0;
  for (int y = half; y < in.height() - half; ++y)
    for (int x = half; x < in.width() - half; ++x)
      worst = std::max(worst, std::abs(sheet.at(x, y) - naive(from, u, v, in, x, y)));
  return worst;
}

TEST(Search, FindsAWholePixelShift) {
  const Pattern pattern(1, 35);
  const Image before = pattern.drawn(120, 100), after = pattern.drawn(120, 100, 7, -4);
  SummedImage summed;
  summed.assign(after);
  CorrelationSheet sheet;
  const auto found = search(sheet, summed, patch_at(before, 60, 50), circle({60, 50}, 12), 60);
  ASSERT_TRUE(found);
  EXPECT_LT((found->pixel - Vector2d(67, 46)).norm(),
            0.15);  // a correlation peak is not exactly quadratic
  EXPECT_GT(found->correlation, 0.99);
}

TEST(Search, FindsASubpixelShift) {
  double squares = 0;
  int count = 0;
  for (std::uint64_t seed = 20; seed < 30; ++seed)
    for (const Vector2d& shift : {Vector2d(0.3, -0.4), Vector2d(-3.25, 2.5), Vector2d(5.1, 4.8)}) {
      const Pattern pattern(seed, 35);
      const Image before = pattern.drawn(100, 90), after = pattern.drawn(100, 90, shift.x(), shift.y());
      SummedImage summed;
      summed.assign(after);
      CorrelationSheet sheet;
      const auto found = search(sheet, summed, patch_at(before, 50, 45), circle({50, 45}, 9), 60);
      ASSERT_TRUE(found);
      const double off = (found->pixel - Vector2d(50, 45) - shift).norm();
      EXPECT_LT(off, 0.6) << shift.transpose();
      squares += off * off;
      ++count;
    }
  // a parabola along each axis has an error where the peak is oblique; whole pixels would give 0.4 here
  EXPECT_LT(std::sqrt(squares / count), 0.25);
}

/// The corner of a dark rectangle to the right and below of `corner`, every pixel the mean over its square.
Image dark_corner(const Vector2d& corner) {
  Image image(41, 41);
  const auto covered = [](int pixel, double from) { return std::clamp(pixel + 0.5 - from, 0.0, 1.0); };
  for (int v = 0; v < 41; ++v)
    for (int u = 0; u < 41; ++u)
      image(u, v) =
          static_cast<std::uint8_t>(std::lround(236 - 222 * covered(u, corner.x()) * covered(v, corner.y())));
  return image;
}

/// By the peak of the correlation itself 0.026 px inside, and by that of the squared difference 0.03 px outside.
TEST(Search, FindsDarkCornersWithoutBias) {
  RandomStream random(1, "corners");
  const auto anywhere = [&] { return Vector2d(random.uniform(19.5, 20.5), random.uniform(19.5, 20.5)); };
  constexpr int count = 4000;
  Vector2d sum = Vector2d::Zero();
  for (int i = 0; i < count; ++i) {
    const Vector2d then = anywhere(), now = anywhere();
    const auto texture = cut_texture(dark_corner(then), then, 15, half);
    const Image image = dark_corner(now);
    SummedImage summed;
    summed.assign(image);
    CorrelationSheet sheet;
    const PatchTemplate patch = warp(*texture, Matrix2d::Identity(), size).value();
    sum += search(sheet, summed, patch, circle({20, 20}, 4), 60)->pixel - now;
  }
  EXPECT_LT((sum / count).cwiseAbs().maxCoeff(), 0.006) << "five standard errors are 0.004 px";
}

TEST(Search, IsInvariantToBrightnessAndContrast) {
  const Image before = Pattern(5, 35).drawn(120, 100), after = Pattern(5, 14).drawn(120, 100, 3, 2, 170);
  SummedImage summed;
  summed.assign(after);
  CorrelationSheet sheet;
  const auto found = search(sheet, summed, patch_at(before, 60, 50), circle({60, 50}, 9), 60);
  ASSERT_TRUE(found);
  EXPECT_LT((found->pixel - Vector2d(63, 52)).norm(), 0.15);
  EXPECT_GT(found->correlation, 0.99);
}

TEST(Search, IgnoresABetterMatchOutsideTheEllipse) {
  const Image source = Pattern(6, 35).drawn(60, 60);
  Image image = Pattern(7, 8).drawn(120, 100);
  RandomStream random(8, "worn");
  for (int r = -half; r <= half; ++r)
    for (int c = -half; c <= half; ++c) {
      // inside the bounding box of the ellipse, but outside the ellipse
      image(60 + 7 + c, 50 + 7 + r) = source(30 + c, 30 + r);
      image(60 - 5 + c, 50 - 5 + r) =
          static_cast<std::uint8_t>(std::clamp(source(30 + c, 30 + r) + 12 * random.normal(), 0.0, 255.0));
    }
  SummedImage summed;
  summed.assign(image);
  CorrelationSheet sheet;
  const PatchTemplate patch = patch_at(source, 30, 30);
  const auto found = search(sheet, summed, patch, circle({60, 50}, 9), 60);
  ASSERT_TRUE(found);
  EXPECT_LT((found->pixel - Vector2d(55, 45)).norm(), 0.7);
  EXPECT_LT(found->correlation, 0.99);
  const auto wider = search(sheet, summed, patch, circle({60, 50}, 10), 60);
  ASSERT_TRUE(wider);
  EXPECT_LT((wider->pixel - Vector2d(67, 57)).norm(), 0.2);
  const auto shorter = search(sheet, summed, patch, circle({60, 50}, 10), 6);
  ASSERT_TRUE(shorter);
  EXPECT_LT((shorter->pixel - Vector2d(55, 45)).norm(), 0.7) << "not further out than commanded";
}

TEST(Search, IsTheMaximumOverTheEllipse) {
  const Image image = Pattern(9, 30).drawn(120, 100);
  const PatchTemplate patch = patch_at(Pattern(10, 30).drawn(60, 60), 30, 30);
  SummedImage summed;
  summed.assign(image);
  RandomStream random(11, "ellipses");
  for (int trial = 0; trial < 40; ++trial) {
    Matrix2d A;
    for (int i = 0; i < 4; ++i) A(i) = random.uniform(-4, 4);
    const Ellipse ellipse{{random.uniform(0, 120), random.uniform(0, 100)},
                          A * A.transpose() + 0.5 * Matrix2d::Identity(),
                          2.5};
    CorrelationSheet all, sheet;
    all.start(summed, patch, 0, 119, 0, 99);
    double best = -2;
    Vector2d at;
    for (int v = 0; v < 100; ++v)
      for (int u = 0; u < 120; ++u)
        if (inside(ellipse, u, v) && all.at(u, v) > best) {
          best = all.at(u, v);
          at = Vector2d(u, v);
        }
    const auto found = search(sheet, summed, patch, ellipse, 60);
    ASSERT_EQ(found.has_value(), best > -2);
    if (!found) continue;
    EXPECT_EQ(found->correlation, best);
    EXPECT_LE((found->pixel - at).cwiseAbs().maxCoeff(), 0.5);
  }
}

/// Of points in gates of these half axes at random places and angles, the share whose nearest pixel is searched.
double share_searched(double long_px, double short_px, bool widened) {
  RandomStream random(13, "gates");
  constexpr int gates = 400, points = 50;
  int searched = 0;
  for (int i = 0; i < gates; ++i) {
    const double angle = random.uniform(0, std::numbers::pi);
    const Matrix2d turn = Eigen::Rotation2Dd(angle).toRotationMatrix();
    const Matrix2d axes = turn * Vector2d(long_px, short_px).asDiagonal() / 3;
    const Ellipse gate{{random.uniform(10, 11), random.uniform(10, 11)}, axes * axes.transpose(), 3};
    const Ellipse where = widened ? with_nearest_pixels(gate) : gate;
    for (int k = 0; k < points; ++k) {
      const double on = random.uniform(0, 2 * std::numbers::pi), of = std::sqrt(random.uniform(0, 1));
      const Vector2d peak = gate.center + 3 * of * axes * Vector2d(std::cos(on), std::sin(on));
      const Vector2d pixel = peak.array().round();
      searched += inside(where, pixel.x(), pixel.y());
    }
  }
  return static_cast<double>(searched) / (gates * points);
}

TEST(Search, CoversThePixelsNearestToPeaksInSmallAndThinGates) {
  EXPECT_EQ(share_searched(0.01, 0.01, true), 1);
  EXPECT_EQ(share_searched(0.5, 0.5, true), 1);
  EXPECT_GT(share_searched(1, 1, true), 0.98);
  EXPECT_GT(share_searched(6, 0.2, true), 0.97);
  EXPECT_GT(share_searched(20, 0.05, true), 0.95) << "all but the ends";
  EXPECT_LT(share_searched(6, 0.2, false), 0.4) << "what is repaired";
  const Ellipse large{{10, 10}, Matrix2d::Identity(), 3};
  EXPECT_TRUE(with_nearest_pixels(large).covariance.isApprox(large.covariance, 1e-12));
}

TEST(Search, PixelsSharedByTwoEllipsesAreComputedOnce) {
  const Image image = Pattern(12, 30).drawn(120, 100);
  const PatchTemplate patch = patch_at(image, 30, 30);
  SummedImage summed;
  summed.assign(image);
  CorrelationSheet sheet;
  sheet.start(summed, patch, 0, 119, 0, 99);
  const Ellipse one = circle({60, 50}, 10), other = circle({66, 53}, 10);
  int first = 0, both = 0;
  for (int v = 0; v < 100; ++v)
    for (int u = 0; u < 120; ++u) {
      first += inside(one, u, v);
      both += inside(one, u, v) || inside(other, u, v);
    }
  constexpr int neighbors = 4;  // neighbors of the maximum, for the parabola
  EXPECT_EQ(sheet.computed(), 0);
  ASSERT_TRUE(search(sheet, one, 60));
  EXPECT_GE(sheet.computed(), first);
  EXPECT_LE(sheet.computed(), first + neighbors);
  ASSERT_TRUE(search(sheet, other, 60));
  EXPECT_GE(sheet.computed(), both);
  EXPECT_LE(sheet.computed(), both + 2 * neighbors);
  const int done = sheet.computed();
  search(sheet, one, 60);
  search(sheet, other, 60);
  EXPECT_EQ(sheet.computed(), done);
}

TEST(Search, AUniformImageMatchesNothing) {
  const Image flat(120, 100, 90);
  SummedImage summed;
  summed.assign(flat);
  CorrelationSheet sheet;
  const auto found =
      search(sheet, summed, patch_at(Pattern(13, 30).drawn(60, 60), 30, 30), circle({60, 50}, 9), 60);
  EXPECT_TRUE(!found || found->correlation == 0);
}

TEST(Search, TheEllipseMayExtendBeyondTheImage) {
  const Image image = Pattern(14, 30).drawn(64, 48);
  SummedImage summed;
  summed.assign(image);
  CorrelationSheet sheet;
  for (const int u : {half, 63 - half})
    for (const int v : {half, 47 - half}) {
      const Vector2d corner(u < 32 ? 0 : 63, v < 24 ? 0 : 47);
      const auto found = search(sheet, summed, patch_at(image, u, v), circle(corner, 9), 60);
      ASSERT_TRUE(found);
      EXPECT_LE((found->pixel - Vector2d(u, v)).cwiseAbs().maxCoeff(), 0.1);
      EXPECT_EQ(sheet.at(u < 32 ? u - 1 : u + 1, v), -2);
    }
  EXPECT_FALSE(search(sheet, summed, patch_at(image, 30, 30), circle({-40, 20}, 9), 60));
  EXPECT_FALSE(search(sheet, summed, patch_at(image, 30, 30), circle({500, 500}, 9), 60));
  EXPECT_FALSE(search(sheet, summed, patch_at(image, 30, 30), circle({1, 1}, 3), 60));
}

TEST(Correlation, ApproximatesTheCorrelationCoefficient) {
  const Image image = Pattern(15, 35).drawn(70, 60);
  for (const int u : {10, 23, 31, 44}) EXPECT_LT(worst_difference(image, image, u, 30), 0.015);
}

// An unwarped patch has integer pixels, so that rounding 8 * (pixel - mean) has the same error for all of them.
// Without a correction the image's mean would add up to half the squared size to the product.
TEST(Correlation, EqualsTheCorrelationCoefficient) {
  const Image image = Pattern(15, 35).drawn(70, 60);
  for (const int u : {10, 23, 31, 44}) EXPECT_LT(worst_difference(image, image, u, 30), 1e-3);
}

TEST(Correlation, EqualsTheCorrelationCoefficientAtLowContrast) {
  const Image image = Pattern(16, 4).drawn(70, 60, 0, 0, 200);
  for (const int u : {10, 23, 31, 44}) EXPECT_LT(worst_difference(image, image, u, 30), 1e-2);
}

TEST(SummedImage, IsTheSumOverTheSquare) {
  RandomStream random(17, "pixels");
  Image image(320, 240, 255);  // bright enough for sums beyond 2^32
  for (int v = 0; v < 240; ++v)
    for (int u = 0; u < 320; ++u)
      if (random.below(8) == 0) image(u, v) = static_cast<std::uint8_t>(random.below(256));
  SummedImage summed;
  summed.assign(Image(10, 400));  // previously of another size
  summed.assign(image);
  const auto check = [&](int u, int v, int side) {
    double sum = 0, squares = 0;
    for (int y = v; y < v + side; ++y)
      for (int x = u; x < u + side; ++x) {
        sum += image(x, y);
        squares += image(x, y) * image(x, y);
      }
    EXPECT_EQ(summed.over(u, v, side).sum, sum);
    EXPECT_EQ(summed.over(u, v, side).squares, squares);
  };
  check(0, 0, 1);
  check(0, 0, 15);
  check(305, 225, 15);
  check(0, 225, 15);
  check(305, 0, 15);
  for (int i = 0; i < 100; ++i) check(random.below(300), random.below(220), 1 + random.below(20));
}

}  // namespace
}  // namespace incognita
