// Every operation of a sum of rows, against the dense matrix.
#include "incognita/analysis/observability/row_sum.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "incognita/math/random.hpp"

namespace incognita {
namespace {

Eigen::MatrixXd random_rows(int rows, int columns, RandomStream& random) {
  Eigen::MatrixXd out(rows, columns);
  for (double& x : out.reshaped()) x = random.uniform(-1, 1);
  return out;
}

Eigen::MatrixXd removed(const Eigen::MatrixXd& M, int first, int count) {
  std::vector<Eigen::Index> kept;
  for (Eigen::Index i = 0; i < M.cols(); ++i)
    if (i < first || i >= first + count) kept.push_back(i);
  return M(kept, kept);
}

struct Sums {
  RandomStream random{1, "row sum"};
  RowSum sum;
  Eigen::MatrixXd dense;

  explicit Sums(int size) {
    sum.grow(size);
    const Eigen::MatrixXd rows = random_rows(2 * size, size, random);
    sum.add(rows);
    dense = rows.transpose() * rows;
  }
  void compare() const {
    ASSERT_EQ(sum.size(), dense.cols());
    EXPECT_LT((sum.matrix() - dense).norm(), 1e-12 * (1 + dense.norm()));
  }
};

TEST(RowSum, SubtractsWhatWasAdded) {
  Sums s(37);
  const Eigen::MatrixXd rows = random_rows(3, 37, s.random);
  s.sum.subtract(rows);
  s.dense -= rows.transpose() * rows;
  s.compare();
}

TEST(RowSum, GivesAndReplacesRowsAnywhere) {
  for (const int first : {0, 5, 31}) {
    Sums s(37);
    EXPECT_EQ(s.sum.rows(first, 6), s.sum.matrix().middleRows(first, 6)) << first;
    Eigen::MatrixXd rows = random_rows(6, 37, s.random);
    const Eigen::MatrixXd own = rows.middleCols(first, 6);
    rows.middleCols(first, 6) = own + own.transpose();
    s.sum.set_rows(first, rows);
    s.dense.middleRows(first, 6) = rows;
    s.dense.middleCols(first, 6) = rows.transpose();
    s.compare();
  }
}

TEST(RowSum, RemovesRowsAnywhereAndGrowsAgain) {
  for (const int first : {0, 5, 31}) {
    Sums s(37);
    s.sum.remove(first, 6);
    s.dense = removed(s.dense, first, 6);
    s.compare();
    for (const int by : {4, 9}) {  // within the memory of the removed rows, and beyond
      s.sum.grow(by);
      const auto size = s.dense.cols() + by;
      s.dense.conservativeResizeLike(Eigen::MatrixXd::Zero(size, size));
      s.compare();
      const Eigen::MatrixXd rows = random_rows(4, static_cast<int>(size), s.random);
      s.sum.add(rows);
      s.dense += rows.transpose() * rows;
      s.compare();
    }
  }
}

TEST(RowSum, MayLoseAllRows) {
  Sums s(6);
  s.sum.remove(0, 6);
  EXPECT_EQ(s.sum.size(), 0);
  s.sum.grow(2);
  EXPECT_TRUE(s.sum.matrix().isZero(0));
}

}  // namespace
}  // namespace incognita
