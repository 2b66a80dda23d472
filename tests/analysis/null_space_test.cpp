// Ranks and null spaces: independent of units, and reported as ambiguous where the singular values leave no
// gap.
#include "incognita/analysis/observability/null_space.hpp"

#include <gtest/gtest.h>

#include <Eigen/QR>

#include <cmath>

#include "incognita/math/random.hpp"

namespace incognita {
namespace {

Eigen::MatrixXd random_matrix(int rows, int columns, RandomStream& random) {
  Eigen::MatrixXd M(rows, columns);
  for (double& entry : M.reshaped()) entry = random.normal();
  return M;
}

NoisyRows exact(const Eigen::MatrixXd& M) { return NoisyRows::exact(M); }

TEST(NullSpace, FindsTheRankOfAConstructedMatrix) {
  RandomStream random(1, "ranks");
  for (int trial = 0; trial < 200; ++trial) {
    const int n = 1 + random.below(12), m = 1 + random.below(30), rank = random.below(std::min(n, m) + 1);
    const Eigen::MatrixXd M = random_matrix(m, rank, random) * random_matrix(rank, n, random);
    const NullSpace space = null_space(exact(M));
    ASSERT_EQ(space.rank, rank) << n << " columns, " << m << " rows";
    ASSERT_EQ(space.basis.cols(), n - rank);
    EXPECT_LT((M * space.basis).norm(), 1e-10 * (1 + M.norm()));
    EXPECT_FALSE(space.ambiguous);
  }
}

TEST(NullSpace, IsIndependentOfUnits) {
  RandomStream random(2, "units");
  for (int trial = 0; trial < 100; ++trial) {
    const Eigen::MatrixXd M = random_matrix(9, 3, random) * random_matrix(3, 6, random);
    Eigen::VectorXd rows(9), columns(6);
    for (double& scale : rows) scale = std::pow(10, random.uniform(-6, 6));
    for (double& scale : columns) scale = std::pow(10, random.uniform(-6, 6));
    const NullSpace space = null_space(exact(rows.asDiagonal() * M * columns.asDiagonal()));
    ASSERT_EQ(space.rank, 3) << "gap " << space.gap;
    EXPECT_FALSE(space.ambiguous);
  }
}

TEST(NullSpace, IgnoresRowsThatAreRounding) {
  NoisyRows M = exact(Eigen::MatrixXd(3, 3));
  M.noise.setConstant(1e-15);
  M.rows << 1, 0, 0, 0, 1, 0, 1e-17, 3e-17, 1e-16;
  EXPECT_EQ(null_space(M).rank, 2);
  M.noise.setZero();
  EXPECT_EQ(null_space(M).rank, 3) << "the same row, stated as exact";
}

TEST(NullSpace, DoesNotScaleUpAColumnOfRounding) {
  Eigen::MatrixXd M(3, 3);
  M << 1, 2, 1e-18, 3, 4, -2e-18, 5, 7, 1e-18;
  NoisyRows rows = exact(M);
  rows.noise.setConstant(1e-12);
  const NullSpace space = null_space(rows);
  EXPECT_EQ(space.rank, 2);
  EXPECT_FALSE(space.ambiguous);
}

TEST(NullSpace, ReportsAFaintColumnAsAmbiguous) {
  Eigen::MatrixXd M(3, 3);
  M << 1, 2, 1e-13, 3, 4, -2e-13, 5, 7, 1e-13;
  NoisyRows rows = exact(M);
  rows.noise.setConstant(1e-12);
  for (const NoisyRows& r : {rows, rows.condensed()}) {
    EXPECT_EQ(null_space(r).rank, 2);
    EXPECT_TRUE(null_space(r).ambiguous);
  }
  EXPECT_EQ(null_space(exact(M)).rank, 3) << "the same entries, stated as exact";
}

TEST(NullSpace, EqualsThatOfCondensedRows) {
  RandomStream random(5, "condensed");
  NoisyRows all = exact(Eigen::MatrixXd(0, 6)), carried = all;
  for (int part = 0; part < 4; ++part) {
    const NoisyRows more = exact(random_matrix(9, 1, random) * random_matrix(1, 6, random));
    all.append(more);
    NoisyRows both = more.condensed();
    both.append(carried);
    carried = both.condensed();
    const NullSpace whole = null_space(all), from_less = null_space(carried);
    EXPECT_LE(carried.rows.rows(), 6);
    ASSERT_EQ(whole.rank, part + 1);
    ASSERT_EQ(from_less.rank, part + 1);
    for (int j = 0; j < whole.nullity; ++j) EXPECT_TRUE(from_less.contains(whole.basis.col(j)));
  }
}

TEST(NullSpace, ReportsAMissingGapAsAmbiguous) {
  // Singular values that fall by a factor of 30 each, across the tolerance
  const int n = 10;
  RandomStream random(3, "gap");
  Eigen::MatrixXd D = Eigen::MatrixXd::Zero(n, n);
  for (int i = 0; i < n; ++i) D(i, i) = std::pow(30.0, -i);
  const Eigen::MatrixXd U = random_matrix(n, n, random).householderQr().householderQ();
  const Eigen::MatrixXd V = random_matrix(n, n, random).householderQr().householderQ();
  NoisyRows M = exact(U * D * V.transpose());
  M.weighed = true;
  const NullSpace space = null_space(M);
  EXPECT_TRUE(space.ambiguous);
  EXPECT_LT(space.gap, 1e3);
}

TEST(NullSpace, OfAnEmptyMatrixIsTheWholeSpace) {
  const NullSpace space = null_space(exact(Eigen::MatrixXd::Zero(2, 4)));
  EXPECT_EQ(space.nullity, 4);
  EXPECT_TRUE(space.contains(Eigen::Vector4d::UnitX()));
  EXPECT_EQ(null_space(exact(Eigen::MatrixXd(0, 3))).nullity, 3);
}

TEST(NullSpace, FindsItsDirectionsInAnyUnits) {
  Eigen::MatrixXd M(2, 3);
  M << 1, -1e6, 0, 0, 1e6, -1;  // x = 1e6 y, z = 1e6 y
  const NullSpace space = null_space(exact(M));
  EXPECT_TRUE(space.contains(Eigen::Vector3d(1e6, 1, 1e6)));
  EXPECT_FALSE(space.contains(Eigen::Vector3d(1e6, 1, 0.999e6)));
  EXPECT_FALSE(space.contains(Eigen::Vector3d::Zero()));
  EXPECT_GT(space.observed_share(Eigen::Vector3d::UnitY()), 0.1);
}

/// A matrix whose null space is spanned by the columns of B.
NullSpace space_of(const Eigen::MatrixXd& B) {
  const Eigen::MatrixXd Q = B.householderQr().householderQ();
  return null_space(exact(Q.rightCols(B.rows() - B.cols()).transpose()));
}

TEST(ReadableBasis, SpansTheSameSpaceInAnyUnits) {
  for (const double k : {1e-11, 1e-9, 1.0, 1e9, 1e11}) {
    Eigen::MatrixXd M(2, 4);
    M << 1, -k, 0, 0, 0, k, -1, 0;  // x = k y = z, and w, which is not measured
    const NullSpace space = null_space(exact(M));
    const auto basis = readable_basis(space);
    ASSERT_EQ(basis.size(), 2u);
    for (const Eigen::VectorXd& v : basis)
      EXPECT_TRUE(space.contains(v)) << "k = " << k << ": " << v.transpose();
    EXPECT_EQ(basis[1], Eigen::Vector4d(0, 0, 0, 1));
  }
}

TEST(ReadableBasis, IsSparseAndIntegerWherePossible) {
  RandomStream random(4, "basis");
  Eigen::MatrixXd nice(5, 2);  // thesis (4.20)
  nice << 1, 0, 0, 1, 0, 0, 1, 0, 0, 1;
  const Eigen::MatrixXd mixed = nice * random_matrix(2, 2, random);
  const auto basis = readable_basis(space_of(mixed));
  ASSERT_EQ(basis.size(), 2u);
  EXPECT_EQ(basis[0], nice.col(0));
  EXPECT_EQ(basis[1], nice.col(1));
}

TEST(ReadableBasis, TurnsSimpleFractionsIntoIntegers) {
  EXPECT_EQ(readable_basis(space_of(Eigen::Vector3d(2, 1, 0) / 7)).front(), Eigen::Vector3d(2, 1, 0));
  EXPECT_EQ(readable_basis(space_of(Eigen::Vector3d(3, -2, 1e-13))).front(), Eigen::Vector3d(3, -2, 0));
  const Eigen::VectorXd kept = readable_basis(space_of(Eigen::Vector2d(1, std::sqrt(2)))).front();
  EXPECT_DOUBLE_EQ(kept[1], std::sqrt(2));
}

TEST(WrittenCombination, IsReadable) {
  EXPECT_EQ(written_combination(Eigen::Vector3d(1, 0, -2), {"x", "y", "z"}), "x - 2 z");
  EXPECT_EQ(written_combination(Eigen::Vector2d(-1, 0.5), {"x", "y"}), "-x + 0.5 y");
  EXPECT_EQ(written_combination(Eigen::Vector2d(0, 0), {"x", "y"}), "0");
}

}  // namespace
}  // namespace incognita
