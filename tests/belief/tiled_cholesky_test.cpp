// A factorization in steps gives the log-determinants of the dense one.
#include "incognita/belief/tiled_cholesky.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>

#include "tests/allocations.hpp"
#include "tests/belief/dense.hpp"

namespace incognita::testing {
namespace {

void fill(TiledCholesky& cholesky, const Eigen::MatrixXd& P) {
  cholesky.start(static_cast<int>(P.rows()));
  for (int j = 0; j < P.cols(); ++j)
    cholesky.set_column(j, j, P.col(j).data() + j, static_cast<int>(P.rows()) - j);
}

double dense_log_det(const Eigen::MatrixXd& P) {
  return 2 * Eigen::MatrixXd(P.llt().matrixL()).diagonal().array().log().sum();
}

TEST(TiledCholesky, GivesTheLogDeterminantsOfEveryLeadingBlock) {
  RandomStream random(1, "tiles");
  TiledCholesky cholesky;
  for (const int size : {1, 63, 64, 65, 200, 128}) {
    const Eigen::MatrixXd P = random_covariance(random, size);
    fill(cholesky, P);
    while (!cholesky.advance(1))
      ;
    for (const int rows : {0, 1, size / 2, size}) {
      const double expected = rows == 0 ? 0 : dense_log_det(P.topLeftCorner(rows, rows));
      EXPECT_NEAR(cholesky.log_det(rows), expected, 1e-11 * (1 + std::abs(expected)))
          << rows << " of " << size;
    }
  }
}

TEST(TiledCholesky, TakesTheStatedNumberOfSteps) {
  RandomStream random(2, "tiles");
  TiledCholesky cholesky;
  for (const int size : {1, 64, 65, 300}) {
    fill(cholesky, random_covariance(random, size));
    const long steps = TiledCholesky::steps_of(size);
    EXPECT_FALSE(steps > 1 && cholesky.advance(steps - 1)) << size;
    EXPECT_TRUE(cholesky.advance(1)) << size;
    EXPECT_TRUE(cholesky.advance(1)) << "a further call does nothing";
  }
}

TEST(TiledCholesky, DoesNotDependOnTheNumberOfStepsPerCall) {
  RandomStream random(3, "tiles");
  const Eigen::MatrixXd P = random_covariance(random, 250);
  TiledCholesky one, all;
  fill(one, P), fill(all, P);
  while (!one.advance(1))
    ;
  while (!all.advance(1000))
    ;
  EXPECT_EQ(one.log_det(250), all.log_det(250));
}

TEST(TiledCholesky, HasNoLogDeterminantBeyondWhatIsPositiveDefinite) {
  RandomStream random(4, "tiles");
  Eigen::MatrixXd P = random_covariance(random, 200);
  P(150, 150) = -1;
  TiledCholesky cholesky;
  fill(cholesky, P);
  while (!cholesky.advance(3))
    ;
  EXPECT_TRUE(std::isnan(cholesky.log_det(200)));
  EXPECT_NEAR(cholesky.log_det(128), dense_log_det(P.topLeftCorner(128, 128)), 1e-9);
}

using TiledCholeskyAllocation = Allocation;

TEST_F(TiledCholeskyAllocation, IsAbsentForAMatrixThatIsNotLarger) {
  RandomStream random(5, "tiles");
  const Eigen::MatrixXd P = random_covariance(random, 200);
  TiledCholesky cholesky;
  fill(cholesky, P);
  EXPECT_EQ(allocations_in([&] {
              fill(cholesky, P);
              while (!cholesky.advance(2))
                ;
            }),
            0);
}

TEST(CopiedCovariance, HasTheLeadingErrorsLast) {
  RandomStream random(6, "copy");
  const Map map(random, {3, 3}, {2, 2, 2});
  const Eigen::MatrixXd P = map.belief.dense_covariance();
  const int first = 3, last = 3, size = 9, kept = 6;
  Eigen::MatrixXd expected(size, size);
  expected.topLeftCorner(kept, kept) = P.bottomRightCorner(kept, kept);
  expected.bottomRightCorner(last, last) = P.block(first, first, last, last);
  expected.bottomLeftCorner(last, kept) = P.block(first, first + last, last, kept);
  Eigen::MatrixXd copy = Eigen::MatrixXd::Zero(size, size);
  map.belief.copy_covariance(first, last, copy.data(), size);
  EXPECT_EQ(Eigen::MatrixXd(copy.triangularView<Eigen::Lower>()),
            Eigen::MatrixXd(expected.triangularView<Eigen::Lower>()));
  TiledCholesky cholesky;
  map.belief.copy_covariance(first, last, cholesky);
  while (!cholesky.advance(1))
    ;
  const Eigen::MatrixXd both = expected.selfadjointView<Eigen::Lower>();
  EXPECT_NEAR(cholesky.log_det(size), dense_log_det(both), 1e-10);
}

}  // namespace
}  // namespace incognita::testing
