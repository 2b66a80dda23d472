// Reflectors found in the intensities of a laser scan.
#include "incognita/io/recordings/reflectors.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

namespace incognita {
namespace {

using std::numbers::pi;

struct HandMadeScan {
  std::vector<double> ranges_m = std::vector<double>(361, 81.91);
  std::vector<double> intensities = std::vector<double>(361, 0.0);

  HandMadeScan& post(std::size_t beam, double range_m) {
    ranges_m[beam] = range_m;
    intensities[beam] = 8192;
    return *this;
  }
  std::vector<Detection> find() const { return find_reflectors(ranges_m, intensities); }
};

TEST(Reflectors, AreAtTheMeanOfTheirBeams) {
  EXPECT_TRUE(HandMadeScan().find().empty());
  const auto found = HandMadeScan().post(0, 5).post(180, 10).post(182, 10.5).post(360, 20).find();
  ASSERT_EQ(found.size(), 3u);
  EXPECT_NEAR(found[0].bearing_rad, -pi / 2, 1e-12) << "beam 1 is to the right";
  EXPECT_NEAR(found[1].bearing_rad, radians(0.5), 1e-12);
  EXPECT_DOUBLE_EQ(found[1].range_m, 10.25);
  EXPECT_NEAR(found[2].bearing_rad, pi / 2, 1e-12);
  for (const Detection& one : found) EXPECT_EQ(one.identity, Detection::unknown);
}

TEST(Reflectors, AreSeparatedByTheGap) {
  EXPECT_EQ(HandMadeScan().post(10, 5).post(12, 5).post(14, 5).find().size(), 1u);
  EXPECT_EQ(HandMadeScan().post(10, 5).post(13, 5).find().size(), 2u);
}

TEST(Reflectors, ExcludeTheVehicleAndWhatIsBeyondTheYard) {
  EXPECT_TRUE(HandMadeScan().post(10, 0.85).post(100, 1).post(200, 30).post(300, 81.91).find().empty());
  EXPECT_EQ(HandMadeScan().post(10, 1.01).post(200, 29.99).find().size(), 2u);
}

TEST(Reflectors, IgnoreBeamsWithoutARange) {
  const double nan = std::nan("");
  const auto found = HandMadeScan().post(10, nan).post(11, 5).post(12, INFINITY).post(100, nan).find();
  ASSERT_EQ(found.size(), 1u);
  EXPECT_DOUBLE_EQ(found[0].range_m, 5);
  EXPECT_NEAR(found[0].bearing_rad, radians(5.5 - 90), 1e-12);
  EXPECT_THROW(find_reflectors(std::vector<double>(3), std::vector<double>(2)), std::invalid_argument);
}

}  // namespace
}  // namespace incognita
