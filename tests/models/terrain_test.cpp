// Terrain: derivatives equal those of the height; a height map interpolates its heights smoothly.
#include "incognita/models/motion/terrain.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "incognita/math/random.hpp"
#include "tests/models/dual.hpp"
#include "tests/models/grounds.hpp"

namespace incognita {
namespace {

using Eigen::RowVector2d;
using Eigen::Vector2d;
using Dual2 = Dual<2>;

std::vector<Terrain> every_kind() {
  return {Terrain(), grounds::steep_slope(), grounds::gentle_waves(), grounds::steep_waves(),
          grounds::small_height_map()};
}

/// Anywhere, far away, on cell borders of the height map, at its corner and beyond.
std::vector<Vector2d> places() {
  std::vector<Vector2d> all{{0, 0},   {-9, -15}, {9, 15},     {-9, 3},    {3, -15}, {9 - 1e-12, 15 - 1e-12},
                            {-20, 4}, {50, 60},  {1e3, -1e3}, {-3, -6.5}, {0.5, 3}, {-12, -18}};
  RandomStream random(1, "places");
  for (int i = 0; i < 40; ++i) all.push_back(Vector2d(random.uniform(-10, 10), random.uniform(-16, 16)));
  return all;
}

TEST(Terrain, DerivativesEqualThoseOfTheHeight) {
  for (const Terrain& terrain : every_kind())
    for (const Vector2d& at : places()) {
      const auto x = variables<2>(at);
      const GroundPoint<Dual2> d = terrain.at<Dual2>(x[0], x[1]);
      const GroundPoint<double> p = terrain.at<double>(at.x(), at.y());
      const auto expect = [&](const Dual2& of, const RowVector2d& coded) {
        EXPECT_LE((of.derivatives().transpose() - coded).norm(), 1e-13 * (1 + coded.norm()))
            << at.transpose();
      };
      EXPECT_NEAR(d.height.value(), p.height, 1e-15 * (1 + std::abs(p.height)));
      expect(d.height, {p.x, p.y});
      expect(d.x, {p.xx, p.xy});
      expect(d.y, {p.xy, p.yy});
      expect(d.xx, {p.xxx, p.xxy});
      expect(d.xy, {p.xxy, p.xyy});
      expect(d.yy, {p.xyy, p.yyy});
    }
}

TEST(Waves, HaveTheirAmplitudeLengthAndDirection) {
  const Waves waves{.height_m = 5, .waves = {{.amplitude_m = 0.3, .length_m = 8, .direction_rad = 0.5}}};
  const Vector2d along(std::cos(0.5), std::sin(0.5)), across(-along.y(), along.x());
  const Vector2d crest = 2 * along + 7 * across, trough = -2 * along, next = crest + 8 * along;
  EXPECT_NEAR(waves.at<double>(crest.x(), crest.y()).height, 5.3, 1e-14);
  EXPECT_NEAR(waves.at<double>(next.x(), next.y()).height, 5.3, 1e-14);
  EXPECT_NEAR(waves.at<double>(trough.x(), trough.y()).height, 4.7, 1e-14);
}

double difference(const GroundPoint<double>& a, const GroundPoint<double>& b) {
  return std::abs(a.height - b.height) + std::abs(a.x - b.x) + std::abs(a.y - b.y) + std::abs(a.xx - b.xx) +
         std::abs(a.xy - b.xy) + std::abs(a.yy - b.yy);
}

Eigen::MatrixXd some_heights(int rows, int cols) {
  RandomStream random(3, "heights");
  Eigen::MatrixXd heights(rows, cols);
  for (double& height : heights.reshaped()) height = random.uniform(-1, 1);
  return heights;
}

TEST(HeightMap, InterpolatesItsHeights) {
  for (const auto& [rows, cols] : {std::pair{2, 2}, {2, 5}, {3, 3}, {9, 6}}) {
    const Eigen::MatrixXd heights = some_heights(rows, cols);
    const HeightMap map(heights, 0.25, {-1, 3});
    for (int i = 0; i < rows; ++i)
      for (int k = 0; k < cols; ++k)
        EXPECT_NEAR(map.at<double>(-1 + 0.25 * i, 3 + 0.25 * k).height, heights(i, k), 1e-14);
  }
}

TEST(HeightMap, IsContinuousToTheSecondDerivativeAcrossCellsAndItsBorder) {
  const HeightMap map(some_heights(5, 4), 1);
  for (const double seam : {0.0, 1.0, 2.0, 3.0, 4.0})
    for (const double beside : {-2.0, 0.3, 1.0, 2.7, 3.5}) {
      const double e = 1e-9;
      EXPECT_LT(difference(map.at<double>(seam - e, beside), map.at<double>(seam + e, beside)), 1e-6);
      EXPECT_LT(difference(map.at<double>(beside, seam - e), map.at<double>(beside, seam + e)), 1e-6);
    }
}

TEST(HeightMap, IsExactOnATwistedPlane) {
  const auto height = [](double x, double y) { return 2 - 0.3 * x + 0.8 * y + 0.05 * x * y; };
  Eigen::MatrixXd heights(5, 7);
  for (int i = 0; i < 5; ++i)
    for (int k = 0; k < 7; ++k) heights(i, k) = height(1 + 2 * i, -3 + 2 * k);
  const HeightMap map(heights, 2, {1, -3});
  for (const Vector2d& at :
       {Vector2d(1, -3), {2.2, 3.1}, {9, 9}, {-4, 20}, {30, -8}}) {  // the border, and beyond
    const auto p = map.at<double>(at.x(), at.y());
    EXPECT_NEAR(p.height, height(at.x(), at.y()), 1e-12) << at.transpose();
    EXPECT_NEAR(p.x, -0.3 + 0.05 * at.y(), 1e-12);
    EXPECT_NEAR(p.y, 0.8 + 0.05 * at.x(), 1e-12);
    EXPECT_NEAR(p.xy, 0.05, 1e-12);
    EXPECT_NEAR(p.xx, 0, 1e-12);
  }
}

TEST(HeightMap, ConvergesToSmoothGroundWithTheFourthPowerOfItsSpacing) {
  const Terrain ground = grounds::gentle_waves();
  const auto worst = [&](int cells) {
    const double spacing = 60.0 / cells;
    Eigen::MatrixXd heights(cells + 1, cells + 1);
    for (int i = 0; i <= cells; ++i)
      for (int k = 0; k <= cells; ++k) heights(i, k) = ground.at<double>(spacing * i, spacing * k).height;
    const HeightMap map(heights, spacing);
    double most = 0;
    for (double x = 20; x < 40; x += 0.37)  // away from the border, where the true terrain is curved
      for (double y = 20; y < 40; y += 0.41)
        most = std::max(most, std::abs(map.at<double>(x, y).height - ground.at<double>(x, y).height));
    return most;
  };
  EXPECT_LT(worst(60), 1e-3);
  EXPECT_GT(worst(60) / worst(120), 12);
}

TEST(HeightMap, HasItsExtent) {
  const Terrain map = HeightMap(Eigen::MatrixXd::Zero(3, 5), 2, {-1, 10});
  EXPECT_TRUE(map.contains(-1, 10));
  EXPECT_TRUE(map.contains(3, 18));
  EXPECT_FALSE(map.contains(3.001, 12));
  EXPECT_FALSE(map.contains(0, 9.99));
  EXPECT_FALSE(map.contains(NAN, 12));
  EXPECT_TRUE(Terrain().contains(1e9, -1e9));
}

TEST(Terrain, InvalidParametersAreRefused) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(Terrain(TiltedPlane{.slope_x = nan}), std::invalid_argument);
  EXPECT_THROW(Terrain(Waves{.waves = {{.length_m = 0}}}), std::invalid_argument);
  EXPECT_THROW(Terrain(Waves{.waves = {{.amplitude_m = nan}}}), std::invalid_argument);
  EXPECT_THROW(HeightMap(Eigen::MatrixXd::Zero(1, 5), 1), std::invalid_argument);
  EXPECT_THROW(HeightMap(Eigen::MatrixXd::Zero(5, 0), 1), std::invalid_argument);
  EXPECT_THROW(HeightMap(Eigen::MatrixXd::Constant(3, 3, nan), 1), std::invalid_argument);
  EXPECT_THROW(HeightMap(Eigen::MatrixXd::Zero(3, 3), 0), std::invalid_argument);
  EXPECT_THROW(HeightMap(Eigen::MatrixXd::Zero(3, 3), 1, {nan, 0}), std::invalid_argument);
}

}  // namespace
}  // namespace incognita
