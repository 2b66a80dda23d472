#include "incognita/math/time_stamp.hpp"

#include <gtest/gtest.h>

namespace incognita {
namespace {

TEST(SecondsFromNanoseconds, KeepsTheResolutionOfADouble) {
  EXPECT_EQ(seconds_from_nanoseconds("1403636579763555584"), 1403636579 + 763555584 * 1e-9);
  EXPECT_EQ(seconds_from_nanoseconds("0"), 0.0);
  EXPECT_EQ(seconds_from_nanoseconds("-1500000000"), -1.5);
}

TEST(SecondsFromNanoseconds, AcceptsTrailingZerosAndExponents) {
  EXPECT_EQ(seconds_from_nanoseconds("1403636579763555584.0"), 1403636579 + 763555584 * 1e-9);
  EXPECT_EQ(seconds_from_nanoseconds("1403636579763555584."), 1403636579 + 763555584 * 1e-9);
  EXPECT_EQ(seconds_from_nanoseconds("-2000000000.00"), -2.0);
  EXPECT_NEAR(*seconds_from_nanoseconds("1.403636579763555584e+18"), 1403636579.763555584, 5e-7);
}

TEST(SecondsFromNanoseconds, RefusesEverythingElse) {
  for (const char* wrong : {"", "x", "12 ", "12x", "1.2.3", "nan", "inf", "1e999", "+5", "--5", ".", ".5",
                            "1403636579.763555", "12.5", "1.2345e2"})
    EXPECT_FALSE(seconds_from_nanoseconds(wrong)) << wrong;
}

}  // namespace
}  // namespace incognita
