#include "incognita/vision/align_patch.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "incognita/math/random.hpp"
#include "incognita/vision/search.hpp"
#include "tests/vision/painted_plane.hpp"
#include "tests/vision/pattern.hpp"

namespace incognita {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
constexpr int patch_px = 11, half_px = patch_px / 2, texture_px = 21;
const Matrix2d same = Matrix2d::Identity();

Vector2d within(RandomStream& random, double px) {
  return {random.uniform(-px, px), random.uniform(-px, px)};
}

/// Rms errors per axis of the peak of the correlation and of the alignment that starts from it, px.
struct Errors {
  double peak_squares = 0, aligned_squares = 0;
  int count = 0;

  void add(const Image& image, const PatchTexture& texture, const Matrix2d& texture_from_view,
           const Vector2d& truth) {
    SummedImage summed;
    summed.assign(image);
    CorrelationSheet sheet;
    const auto patch = warp(texture, texture_from_view, patch_px);
    ASSERT_TRUE(patch);
    const auto found = search(sheet, summed, *patch, {truth, 2 * same, 3}, 60);
    ASSERT_TRUE(found);
    const auto aligned = align_patch(image, texture, texture_from_view, patch_px, found->pixel);
    ASSERT_TRUE(aligned);
    peak_squares += (found->pixel - truth).squaredNorm() / 2;
    aligned_squares += (*aligned - truth).squaredNorm() / 2;
    ++count;
  }
  double peak() const { return std::sqrt(peak_squares / count); }
  double aligned() const { return std::sqrt(aligned_squares / count); }
};

TEST(AlignPatch, IsExactInTheImageOfThePatch) {
  RandomStream random(1, "starts");
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Image image = Pattern(seed, 35).drawn(60, 50);
    const Vector2d center(30.3, 24.8);
    const auto texture = cut_texture(image, center, texture_px, half_px);
    const auto at = align_patch(image, *texture, same, patch_px, center + within(random, 0.3));
    ASSERT_TRUE(at);
    // Gray values of whole pixels are compared with interpolated ones, since the center lies between pixels
    EXPECT_LT((*at - center).norm(), 0.01) << seed;
  }
}

TEST(AlignPatch, FindsASharpCornerAtAnyFractionOfAPixel) {
  RandomStream random(2, "corners");
  Errors errors;
  for (int i = 0; i < 200; ++i) {
    const Vector2d then = Vector2d(30, 30) + within(random, 0.5),
                   now = Vector2d(30, 30) + within(random, 0.5);
    const DarkCorner corner{random.uniform(-0.1, 0.1)};
    errors.add(drawn(corner, same, now), *cut_texture(drawn(corner, same, then), then, texture_px, half_px),
               same, now);
  }
  EXPECT_LT(errors.aligned(), 0.04);
  EXPECT_GT(errors.peak(), 0.05) << "what is repaired";
}

/// From half a pixel away: a step that ignored the gain would be too short.
TEST(AlignPatch, FollowsBrightnessAndContrastFromHalfAPixel) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Image then = Pattern(seed, 35).drawn(60, 50), now = Pattern(seed, 14).drawn(60, 50, 0, 0, 170);
    const auto texture = cut_texture(then, Vector2d(30, 25), texture_px, half_px);
    const auto at = align_patch(now, *texture, same, patch_px, {30.4, 24.7});
    ASSERT_TRUE(at) << seed;
    EXPECT_LT((*at - Vector2d(30, 25)).norm(), 0.03) << seed;
  }
}

TEST(AlignPatch, RefusesANegative) {
  const Image image = Pattern(8, 35).drawn(60, 50);
  Image negative(60, 50);
  for (int v = 0; v < 50; ++v)
    for (int u = 0; u < 60; ++u) negative(u, v) = static_cast<std::uint8_t>(255 - image(u, v));
  EXPECT_FALSE(align_patch(negative, *cut_texture(image, Vector2d(30, 25), texture_px, half_px), same,
                           patch_px, {30, 25}));
}

TEST(AlignPatch, FollowsBrightnessAndContrast) {
  RandomStream random(3, "shifts");
  Errors errors;
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    const Vector2d moved = within(random, 1.5);
    const Image then = Pattern(seed, 35).drawn(60, 50),
                now = Pattern(seed, 14).drawn(60, 50, moved.x(), moved.y(), 170);
    errors.add(now, *cut_texture(then, Vector2d(30, 25), texture_px, half_px), same,
               Vector2d(30, 25) + moved);
  }
  EXPECT_LT(errors.aligned(), 0.03);
}

/// Near and far, turned and foreshortened along the diagonal.
TEST(AlignPatch, FindsCornersInOtherViews) {
  RandomStream random(4, "views");
  Matrix2d oblique;
  oblique << 1.3, 0.5, 0.5, 1.3;
  for (const Matrix2d& texture_from_view : {Matrix2d(0.6 * same), Matrix2d(1.8 * same), oblique}) {
    Errors errors;
    for (int i = 0; i < 60; ++i) {
      const Vector2d then = Vector2d(30, 30) + within(random, 0.5),
                     now = Vector2d(30, 30) + within(random, 0.5);
      const DarkCorner corner{random.uniform(-0.2, 0.2)};
      errors.add(drawn(corner, texture_from_view, now),
                 *cut_texture(drawn(corner, same, then), then, 39, half_px), texture_from_view, now);
    }
    EXPECT_LT(errors.aligned(), 0.05) << texture_from_view;
    EXPECT_LT(errors.aligned(), errors.peak()) << texture_from_view;
  }
}

TEST(AlignPatch, IsNearerThanThePeakWhereAPatchIsPartlyHidden) {
  RandomStream random(5, "hidden");
  Errors errors;
  for (int i = 0; i < 100; ++i) {
    const Vector2d then = Vector2d(30, 30) + within(random, 0.5),
                   now = Vector2d(30, 30) + within(random, 0.5);
    const DarkCorner corner{random.uniform(-0.2, 0.2)};
    Image image = drawn(corner, same, now);
    for (int v = 0; v < image.height(); ++v) image(30 + half_px, v) = image(30 + half_px - 1, v) = 200;
    errors.add(image, *cut_texture(drawn(corner, same, then), then, texture_px, half_px), same, now);
  }
  EXPECT_LT(errors.aligned(), 0.6 * errors.peak());
}

TEST(AlignPatch, StaysInImageAndTexture) {
  const Image image = Pattern(6, 35).drawn(60, 50);
  const auto texture = cut_texture(image, Vector2d(30, 25), texture_px, half_px);
  const auto aligned = [&](double u, double v) {
    return align_patch(image, *texture, same, patch_px, {u, v});
  };
  EXPECT_TRUE(aligned(30.2, 24.9));
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  for (const auto& [u, v] : {std::pair{5.4, 25.0},
                             {54.0, 25.0},
                             {30.0, 5.0},
                             {30.0, 44.0},
                             {-1e9, 25.0},
                             {nan, 25.0},
                             {30.0, 1e300}})
    EXPECT_FALSE(aligned(u, v)) << u << ", " << v;
  EXPECT_FALSE(
      align_patch(image, *cut_texture(image, Vector2d(30, 25), patch_px, half_px), same, patch_px, {30, 25}))
      << "a texture no larger than the patch";
  for (const double scale : {2.0, 1e10, nan})
    EXPECT_FALSE(align_patch(image, *texture, scale * same, patch_px, {30, 25})) << scale;
}

TEST(AlignPatch, NeedsGradientsInEveryDirection) {
  const auto edge = [](const Vector2d& at) { return at.x() > 0 ? 30 : 220; };
  const auto gray = [](const Vector2d&) { return 90; };
  const Image along = drawn(edge, same, {30, 30}), uniform = drawn(gray, same, {30, 30});
  EXPECT_FALSE(align_patch(along, *cut_texture(along, Vector2d(30, 30), texture_px, half_px), same, patch_px,
                           {30, 30}));
  EXPECT_FALSE(align_patch(uniform, *cut_texture(uniform, Vector2d(30, 30), texture_px, half_px), same,
                           patch_px, {30, 30}));
}

TEST(AlignPatch, RefusesWhatIsFartherThanAPixel) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Image image = Pattern(seed, 35).drawn(60, 50), moved = Pattern(seed, 35).drawn(60, 50, 2, 0);
    const auto texture = cut_texture(image, Vector2d(30, 25), texture_px, half_px);
    EXPECT_FALSE(align_patch(moved, *texture, same, patch_px, {30, 25})) << seed;
  }
}

}  // namespace
}  // namespace incognita
