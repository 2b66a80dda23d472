// Block-diagonal inflation: equal to the closed forms where they exist, and conservative everywhere.
#include "incognita/belief/inflation.hpp"

#include <numeric>

#include "tests/belief/dense.hpp"

namespace incognita::testing {
namespace {

using Eigen::MatrixXd;
using Sizes = std::vector<int>;

double smallest_eigenvalue(const MatrixXd& symmetric) {
  return Eigen::SelfAdjointEigenSolver<MatrixXd>(symmetric, Eigen::EigenvaluesOnly).eigenvalues()[0];
}

/// The symmetric square root, by eigenvalues instead of singular values.
MatrixXd root(const MatrixXd& psd) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(psd);
  return eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal() *
         eigen.eigenvectors().transpose();
}

/// Positive semidefinite with the given rank, with a wide range of scales.
MatrixXd covariance_of_rank(RandomStream& random, int size, int rank) {
  const Eigen::VectorXd scales = random_matrix(random, size, 1).array().exp();
  const MatrixXd A = scales.asDiagonal() * random_matrix(random, size, rank);
  const MatrixXd P = A * A.transpose();
  return 0.5 * (P + P.transpose());
}

Sizes random_sizes(RandomStream& random, int most) {
  Sizes sizes(1 + random.below(most));
  for (int& size : sizes) size = 1 + random.below(4);
  return sizes;
}

int sum_of(const Sizes& sizes) { return std::accumulate(sizes.begin(), sizes.end(), 0); }

/// The off-diagonal blocks, with zeros for the diagonal blocks.
MatrixXd between_blocks(MatrixXd P, const Sizes& sizes) {
  int first = 0;
  for (const int size : sizes) {
    P.block(first, first, size, size).setZero();
    first += size;
  }
  return P;
}

/// The trace added by inflating each pair of blocks independently.
double pairwise_trace(const MatrixXd& P, const Sizes& sizes) {
  double sum = 0;
  int row = 0;
  for (const int rows : sizes) {
    int column = 0;
    for (const int columns : sizes) {
      const MatrixXd C = P.block(row, column, rows, columns);
      if (column < row) sum += 2 * Eigen::JacobiSVD<MatrixXd>(C).singularValues().sum();
      column += columns;
    }
    row += rows;
  }
  return sum;
}

/// Properties that must hold for any result of the ascent.
void expect_conservative(const Inflation& inflation, const MatrixXd& P, const Sizes& sizes) {
  EXPECT_TRUE(between_blocks(inflation.P, sizes).isZero(0));
  EXPECT_TRUE(inflation.P == inflation.P.transpose());
  EXPECT_GE(smallest_eigenvalue(inflation.P - P), 0);
  EXPECT_NEAR(inflation.trace_added, inflation.P.trace() - P.trace(), 1e-12 * inflation.P.trace());
  EXPECT_GE(inflation.trace_added, inflation.least_trace);
}

TEST(Inflation, OfTwoScalarsIsTheirCorrelation) {
  const Eigen::Matrix2d P{{4, -1.5}, {-1.5, 9}}, expected{{5.5, 0}, {0, 10.5}};
  const Inflation inflation = decorrelate_all(P, Sizes{1, 1});
  EXPECT_TRUE(close(inflation.P, expected, 1e-13));
  EXPECT_DOUBLE_EQ(inflation.least_trace, 3);
  EXPECT_TRUE(inflation.converged);
}

TEST(Inflation, OfTwoBlocksIsTheClosedForm) {
  RandomStream random(1, "two");
  for (int run = 0; run < 50; ++run) {
    const int a = 1 + random.below(5), b = 1 + random.below(20);
    const MatrixXd P = covariance_of_rank(random, a + b, 1 + random.below(a + b));
    const MatrixXd C = P.topRightCorner(a, b);
    MatrixXd expected = P - between_blocks(P, {a, b});
    expected.topLeftCorner(a, a) += root(C * C.transpose());
    expected.bottomRightCorner(b, b) += root(C.transpose() * C);
    const Inflation inflation = decorrelate_all(P, Sizes{a, b});
    expect_conservative(inflation, P, {a, b});
    EXPECT_TRUE(inflation.converged);
    // the square root of a quantity that is rounded to 1e-16
    EXPECT_TRUE(close(inflation.P, expected, 1e-7));
    EXPECT_NEAR(inflation.trace_added, pairwise_trace(P, {a, b}), 1e-11 * P.trace());
  }
}

TEST(Inflation, AscentReachesTheClosedForm) {
  RandomStream random(2, "third");
  for (int run = 0; run < 50; ++run) {
    const int a = 1 + random.below(4), b = 1 + random.below(4);
    MatrixXd P = MatrixXd::Identity(a + b + 1, a + b + 1);  // a third block, uncorrelated with both
    P.topLeftCorner(a + b, a + b) = random_covariance(random, a + b);
    const Inflation ascended = decorrelate_all(P, Sizes{a, b, 1});
    const Inflation closed = decorrelate_all(P.topLeftCorner(a + b, a + b), Sizes{a, b});
    EXPECT_GT(ascended.sweeps, 0);
    EXPECT_EQ(closed.sweeps, 0);
    EXPECT_NEAR(ascended.least_trace, closed.least_trace, 1e-9 * closed.least_trace);
    EXPECT_NEAR(ascended.trace_added, closed.trace_added, 2e-9 * closed.trace_added);
    EXPECT_TRUE(close(ascended.P.topLeftCorner(a + b, a + b), closed.P, 1e-4));
    EXPECT_NEAR(ascended.P(a + b, a + b), 1, 1e-8 * P.trace());
  }
}

/// D - w w' with scalar blocks. The dual problem minimizes |sum of w_i v_i| over unit vectors v_i: zero if no
/// |w_i| exceeds the sum of the others, else the excess.
TEST(Inflation, OfScalarsWithOneCommonPartHasAClosedForm) {
  RandomStream random(3, "rank one");
  for (int run = 0; run < 60; ++run) {
    const int n = 3 + random.below(12);
    Eigen::VectorXd w = random_matrix(random, n, 1);
    const double others = w.tail(n - 1).cwiseAbs().sum();
    const bool one_exceeds = run % 2 == 1;
    w[0] = (one_exceeds ? 1.2 : 0.5 + 0.4 * random.uniform()) * others * (w[0] < 0 ? -1 : 1);
    const double excess = std::max(0.0, 2 * w.cwiseAbs().maxCoeff() - w.cwiseAbs().sum());
    const MatrixXd D = w.squaredNorm() * MatrixXd::Identity(n, n);
    const MatrixXd P = D - w * w.transpose();  // singular
    const Sizes sizes(static_cast<std::size_t>(n), 1);
    const Inflation inflation = decorrelate_all(P, sizes);
    expect_conservative(inflation, P, sizes);
    EXPECT_TRUE(inflation.converged);
    EXPECT_NEAR(inflation.P.trace(), D.trace() - excess * excess, 3e-9 * w.squaredNorm());
    MatrixXd expected = D;
    if (one_exceeds) expected.diagonal() += excess * w.cwiseAbs();
    if (one_exceeds) expected(0, 0) = D(0, 0) - excess * std::abs(w[0]);
    if (one_exceeds || excess == 0) {
      EXPECT_TRUE(close(inflation.P, expected, 1e-4));
    }
  }
}

TEST(Inflation, IsConservativeAndNoWorseThanPairwiseInflation) {
  RandomStream random(4, "any");
  int converged = 0;
  for (int run = 0; run < 200; ++run) {
    const Sizes sizes = random_sizes(random, 12);
    const int n = sum_of(sizes);
    const MatrixXd P = covariance_of_rank(random, n, 1 + random.below(n));
    const Inflation inflation = decorrelate_all(P, sizes);
    expect_conservative(inflation, P, sizes);
    EXPECT_LE(inflation.trace_added, pairwise_trace(P, sizes) + 1e-11 * P.trace());
    converged += inflation.converged;
  }
  EXPECT_GE(converged, 195);
}

TEST(Inflation, IsConservativeWhereverTheAscentStops) {
  RandomStream random(5, "stopped");
  const Sizes sizes{3, 2, 2, 2, 1, 4};
  const MatrixXd P = covariance_of_rank(random, sum_of(sizes), 7);
  const Inflation best = decorrelate_all(P, sizes);
  EXPECT_TRUE(best.converged);
  for (const int most : {1, 2, 3, 5, 8}) {
    const Inflation stopped = decorrelate_all(P, sizes, {.max_sweeps = most});
    EXPECT_EQ(stopped.sweeps, most);
    expect_conservative(stopped, P, sizes);
    EXPECT_LE(stopped.least_trace, best.trace_added);
    EXPECT_GE(stopped.trace_added, best.least_trace);
  }
  EXPECT_FALSE(decorrelate_all(P, sizes, {.max_sweeps = 1}).converged);
}

TEST(Inflation, KeepsABlockDiagonalCovariance) {
  RandomStream random(6, "diagonal");
  const Sizes sizes{3, 2, 4};
  const MatrixXd full = random_covariance(random, 9), P = full - between_blocks(full, sizes);
  for (const Inflation& inflation : {decorrelate_all(P, sizes), decorrelate_all(full, Sizes{9}),
                                     decorrelate_map(full, Sizes{9}), decorrelate_map(full, Sizes{4, 5})}) {
    EXPECT_TRUE(inflation.P == P || inflation.P == full);
    EXPECT_EQ(inflation.trace_added, 0);
    EXPECT_TRUE(inflation.converged);
  }
}

TEST(Inflation, OfTheMapKeepsTheVehicleAndItsCorrelations) {
  RandomStream random(7, "map");
  for (int run = 0; run < 50; ++run) {
    Sizes sizes = random_sizes(random, 12);
    sizes.insert(sizes.begin(), {3, 2});
    const int n = sum_of(sizes), map = n - 3;
    const MatrixXd P = covariance_of_rank(random, n, 1 + random.below(n));
    const Inflation inflation = decorrelate_map(P, sizes);
    EXPECT_TRUE(inflation.P.topRows(3) == P.topRows(3));
    EXPECT_TRUE(inflation.P.leftCols(3) == P.leftCols(3));
    Inflation of_map = inflation;
    of_map.P = inflation.P.bottomRightCorner(map, map);
    expect_conservative(of_map, P.bottomRightCorner(map, map), {sizes.begin() + 1, sizes.end()});
  }
}

TEST(Inflation, IsDeterministicAndIndependentOfUnits) {
  RandomStream random(8, "again");
  const Sizes sizes{3, 2, 2, 2};
  const MatrixXd P = random_covariance(random, 9);
  const Inflation first = decorrelate_all(P, sizes);
  EXPECT_TRUE(first.P == decorrelate_all(P, sizes).P);
  for (const double scale : {0x1p-60, 0x1p60})  // powers of two, which cause no rounding
    EXPECT_TRUE(close(decorrelate_all(scale * P, sizes).P / scale, first.P, 1e-12)) << scale;
}

TEST(Inflation, RefusesSizesThatDoNotFit) {
  const MatrixXd P = MatrixXd::Identity(5, 5);
  EXPECT_THROW(decorrelate_all(P, Sizes{2, 2}), std::invalid_argument);
  EXPECT_THROW(decorrelate_all(P, Sizes{3, 2, 0}), std::invalid_argument);
  EXPECT_THROW(decorrelate_all(P, Sizes{6, -1}), std::invalid_argument);
  EXPECT_THROW(decorrelate_all(P, Sizes{}), std::invalid_argument);
  EXPECT_THROW(decorrelate_all(P.topRows(4), Sizes{4}), std::invalid_argument);
  EXPECT_THROW(decorrelate_map(P, Sizes{2, 2}), std::invalid_argument);
  EXPECT_THROW(decorrelate_map(P, Sizes{}), std::invalid_argument);
  EXPECT_THROW(decorrelate_all(P * std::nan(""), Sizes{2, 3}), std::invalid_argument);
  try {
    decorrelate_all(P, Sizes{2, 2});
  } catch (const std::invalid_argument& refusal) {
    EXPECT_STREQ(refusal.what(), "a covariance of 5x5 has no blocks of 2 + 2");
  }
}

}  // namespace
}  // namespace incognita::testing
