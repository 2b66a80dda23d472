#include "incognita/analysis/evaluation/mapped_share.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace incognita {
namespace {

const Eigen::Vector3d corner(1, 2, 3);

Eigen::Vector3d off_by(double error_m) { return corner + error_m * Eigen::Vector3d(2, -1, 2) / 3; }

TEST(MappedShare, IsTheWeightOfThePartsWithALandmarkNearItsTruth) {
  MappedShare mapped({1, 2, 5});
  EXPECT_EQ(mapped.share(), 0.0);
  mapped.add(1, corner, corner);
  EXPECT_EQ(mapped.share(), 2 / 8.0);
  mapped.add(2, corner, off_by(0.049));
  EXPECT_EQ(mapped.share(), 7 / 8.0);
}

TEST(MappedShare, DoesNotCountALandmarkThatIsOffBy6cm) {
  MappedShare mapped({1, 3});
  mapped.add(0, corner, off_by(0.06));
  mapped.add(1, corner, corner + Eigen::Vector3d(0, 0, std::nan("")));
  EXPECT_EQ(mapped.share(), 0.0);
  mapped.add(0, corner, off_by(0.04));
  EXPECT_EQ(mapped.share(), 0.25) << "one landmark that is near suffices";
}

TEST(MappedShare, DoesNotCountALandmarkOnNoPart) {
  MappedShare mapped({1});
  mapped.add(std::nullopt, corner, corner);
  EXPECT_EQ(mapped.share(), 0.0);
}

TEST(MappedShare, CountsAPartOnceAndForgetsTheMapBefore) {
  MappedShare mapped({1, 1});
  for (int i = 0; i < 3; ++i) mapped.add(0, corner, corner);
  EXPECT_EQ(mapped.share(), 0.5);
  mapped.restart();
  EXPECT_EQ(mapped.share(), 0.0);
  mapped.add(1, corner, corner);
  mapped.add(0, corner, corner);
  EXPECT_EQ(mapped.share(), 1.0);
}

TEST(MappedShare, OfAWorldWithoutPartsIsUnknown) { EXPECT_EQ(MappedShare({}).share(), std::nullopt); }

}  // namespace
}  // namespace incognita
