// Continuity of a height map: across cells, over its border and past its corners neither height nor
// derivatives jump, and its slopes are those of its heights.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "incognita/math/random.hpp"
#include "incognita/models/motion/terrain.hpp"

namespace incognita {
namespace {

using Eigen::Vector2d;

constexpr int rows = 6, cols = 5;
constexpr double spacing_m = 0.7;
const Vector2d origin(-1.3, 4.1), size((rows - 1) * spacing_m, (cols - 1) * spacing_m);

/// Rough: neighbors differ by up to 2 m.
HeightMap rough() {
  RandomStream random(5, "rough");
  Eigen::MatrixXd heights(rows, cols);
  for (double& height : heights.reshaped()) height = random.uniform(-1, 1);
  return {heights, spacing_m, origin};
}

/// Lines across the whole map, along the axes, on cell borders, and oblique, from outside to outside.
struct Line {
  Vector2d from, to;
  Vector2d at(double s) const { return from + s * (to - from); }
};

std::vector<Line> lines() {
  const Vector2d low = origin - Vector2d(2, 2), high = origin + size + Vector2d(2, 2),
                 far(origin.x(), high.y());
  std::vector<Line> all{
      {low, high}, {{low.x(), high.y()}, {high.x(), low.y()}}, {{origin.x(), low.y()}, far}};
  for (int i = 0; i < rows; ++i) {
    const double seam = origin.x() + i * spacing_m;
    all.push_back({{seam, low.y()}, {seam, high.y()}});
    all.push_back({{seam + 0.3, low.y()}, {seam + 0.3, high.y()}});
  }
  for (int k = 0; k < cols; ++k) {
    const double seam = origin.y() + k * spacing_m;
    all.push_back({{low.x(), seam}, {high.x(), seam}});
    all.push_back({{low.x(), seam - 0.2}, {high.x(), seam - 0.2}});
  }
  return all;
}

TEST(RoughHeightMap, HeightSlopeAndCurvatureAreContinuous) {
  const HeightMap map = rough();
  constexpr int steps = 20'000;
  for (const Line& line : lines()) {
    GroundPoint<double> last = map.at<double>(line.from.x(), line.from.y());
    const double step = (line.to - line.from).norm() / steps;
    for (int i = 1; i <= steps; ++i) {
      const Vector2d at = line.at(i / double(steps));
      const auto now = map.at<double>(at.x(), at.y());
      // The change is bounded by the next derivative, whose maximum on this map is given
      ASSERT_LE(std::abs(now.height - last.height), 50 * step) << at.transpose();
      ASSERT_LE(std::hypot(now.x - last.x, now.y - last.y), 60 * step) << at.transpose();
      ASSERT_LE(std::hypot(now.xx - last.xx, now.xy - last.xy, now.yy - last.yy), 200 * step)
          << at.transpose();
      last = now;
    }
  }
}

/// The error of central differences is of second order in the step where the third derivative is continuous,
/// and of first order at a cell border.
TEST(RoughHeightMap, SlopesAndCurvaturesEqualDifferences) {
  const HeightMap map = rough();
  constexpr double h = 1e-5;
  for (const Line& line : lines())
    for (double s = 0; s <= 1; s += 0.0037) {
      const Vector2d p = line.at(s);
      const auto at = [&](double x, double y) { return map.at<double>(p.x() + x, p.y() + y); };
      const auto here = at(0, 0);
      EXPECT_NEAR(here.x, (at(h, 0).height - at(-h, 0).height) / (2 * h), 1e-7) << p.transpose();
      EXPECT_NEAR(here.y, (at(0, h).height - at(0, -h).height) / (2 * h), 1e-7) << p.transpose();
      EXPECT_NEAR(here.xx, (at(h, 0).x - at(-h, 0).x) / (2 * h), 2e-3) << p.transpose();
      EXPECT_NEAR(here.xy, (at(0, h).x - at(0, -h).x) / (2 * h), 2e-3) << p.transpose();
      EXPECT_NEAR(here.yy, (at(0, h).y - at(0, -h).y) / (2 * h), 2e-3) << p.transpose();
    }
}

/// Beyond the border the map continues linearly with the slope at the border.
TEST(RoughHeightMap, ExtrapolatesLinearlyBeyondItsBorderAndCorners) {
  const HeightMap map = rough();
  const Vector2d end = origin + size;
  for (double s = 0; s <= 1; s += 0.05) {
    const double x = origin.x() + s * size.x(), y = origin.y() + s * size.y();
    for (const double out : {0.1, 3.0, 100.0}) {
      const auto left = map.at<double>(origin.x(), y), beyond_left = map.at<double>(origin.x() - out, y);
      EXPECT_NEAR(beyond_left.height, left.height - out * left.x, 1e-9 * out);
      EXPECT_NEAR(beyond_left.x, left.x, 1e-12);
      EXPECT_EQ(beyond_left.xx, 0);
      const auto top = map.at<double>(x, end.y()), beyond_top = map.at<double>(x, end.y() + out);
      EXPECT_NEAR(beyond_top.height, top.height + out * top.y, 1e-9 * out);
      EXPECT_NEAR(beyond_top.y, top.y, 1e-12);
      EXPECT_EQ(beyond_top.yy, 0);
    }
  }
  // Past a corner it is the bilinear surface through the two borders
  const auto corner = map.at<double>(end.x(), end.y()), beyond = map.at<double>(end.x() + 3, end.y() + 2);
  EXPECT_NEAR(beyond.height, corner.height + 3 * corner.x + 2 * corner.y + 6 * corner.xy, 1e-9);
  EXPECT_NEAR(beyond.x, corner.x + 2 * corner.xy, 1e-9);
  EXPECT_NEAR(beyond.y, corner.y + 3 * corner.xy, 1e-9);
  EXPECT_FALSE(map.contains(end.x() + 3, end.y() + 2));
}

}  // namespace
}  // namespace incognita
