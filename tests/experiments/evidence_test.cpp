// Words and verdicts.
#include "experiments/evidence.hpp"

#include <gtest/gtest.h>

namespace incognita {
namespace {

TEST(Evidence, WordsOfAnInterval) {
  EXPECT_EQ(text({0.158, 0.143, 0.1761}, "m"), "0.158 m (0.143 to 0.176)");
}

TEST(Evidence, WhatIsAsGoodAsZeroStaysBelowAPowerOfTen) {
  EXPECT_EQ(below(0), "below 1e-12");
  EXPECT_EQ(below(-3e-16), "below 1e-12");
  EXPECT_EQ(below(2.7e-12), "below 1e-11");
  EXPECT_EQ(below(4e-5), "below 1e-4");
}

TEST(Evidence, ReasonsStayOnlyWhereThereIsSomethingToExplain) {
  Claim claim;
  claim.why = "because";
  EXPECT_EQ(judged(claim, true).verdict, Verdict::holds);
  EXPECT_EQ(judged(claim, true).why, "");
  EXPECT_EQ(judged(claim, false, true).verdict, Verdict::holds_as_corrected);
  EXPECT_EQ(judged(claim, false).verdict, Verdict::does_not_hold);
  EXPECT_EQ(judged(claim, false).why, "because");
}

}  // namespace
}  // namespace incognita
