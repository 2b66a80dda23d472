// Every instruction-set path of the inner loop against Eigen.
#include "incognita/belief/rank_update.hpp"

#include <string>

#include "incognita/belief/aligned_buffer.hpp"
#include "incognita/belief/cholesky.hpp"
#include "tests/belief/dense.hpp"

namespace incognita::testing {
namespace {

constexpr double untouched = -12345;

struct Problem {
  int n, rank, stride;
  Eigen::MatrixXd P, W;
  AlignedBuffer storage, packed;

  Problem(RandomStream& random, int size, int columns)
      : n(size),
        rank(columns),
        stride(round_up_to_panel(n) + 8),
        P(random_matrix(random, n, n)),
        W(random_matrix(random, n, rank)),
        storage(static_cast<std::size_t>(stride) * (n + 3)),
        packed(static_cast<std::size_t>(round_up_to_panel(n)) * rank) {
    std::fill_n(storage.data(), storage.size(), untouched);
    for (int j = 0; j < n; ++j)
      std::copy_n(P.col(j).data(), n, storage.data() + static_cast<long>(j) * stride);
    for (int i = 0; i < n; ++i)
      for (int k = 0; k < rank; ++k) packed.data()[panel_index(i, k, rank)] = W(i, k);
  }
  double at(int i, int j) const { return storage.data()[i + static_cast<long>(j) * stride]; }
};

/// Sizes around the borders of tiles, and some at which rank and rows are split.
std::vector<std::pair<int, int>> sizes(int most_rows, int step) {
  std::vector<std::pair<int, int>> all = {{700, 30}, {430, 191}, {200, 193}, {90, 500}, {410, 390}};
  for (int n = 1; n <= most_rows; ++n)
    for (int rank = 1; rank <= 30; rank += step) all.emplace_back(n, rank);
  return all;
}

TEST(RankUpdate, EveryPathEqualsEigen) {
  RandomStream random(1, "rank");
  for (const RankUpdatePath& path : rank_update_paths())
    for (const auto& [n, rank] : sizes(70, 1)) {
      Problem problem(random, n, rank);
      path.run(problem.storage.data(), problem.stride, n, problem.packed.data(), rank);
      Eigen::MatrixXd expected = problem.P;
      expected.selfadjointView<Eigen::Lower>().rankUpdate(problem.W, -1.0);
      double error = 0;
      for (int j = 0; j < n; ++j)
        for (int i = j; i < n; ++i) error = std::max(error, std::abs(problem.at(i, j) - expected(i, j)));
      ASSERT_LE(error, 1e-12 * expected.cwiseAbs().maxCoeff()) << path.name << " n " << n << " rank " << rank;
    }
}

TEST(Whiten, EveryPathEqualsEigensTriangularSolve) {
  RandomStream random(4, "whiten");
  for (const RankUpdatePath& path : rank_update_paths())
    for (const auto& [n, rank] : sizes(40, 3)) {
      const int stride = round_up_to_panel(n) + 8;
      Eigen::MatrixXd A = random_matrix(random, n, rank), L = random_matrix(random, rank + 2, rank);
      L.diagonal().array() += 5 + rank;
      AlignedBuffer padded(static_cast<std::size_t>(stride) * rank);
      for (int k = 0; k < rank; ++k)
        std::copy_n(A.col(k).data(), n, padded.data() + static_cast<long>(k) * stride);
      AlignedBuffer W(static_cast<std::size_t>(round_up_to_panel(n)) * rank);
      std::fill_n(W.data(), W.size(), untouched);
      AlignedBuffer panels(static_cast<std::size_t>(round_up_to_panel(rank)) * rank);
      for (int i = 0; i < rank; ++i)
        for (int k = 0; k <= i; ++k) panels.data()[panel_index(i, k, rank)] = L(i, k);
      path.whiten(padded.data(), stride, n, panels.data(), rank, W.data());
      const auto lower = L.topRows(rank).triangularView<Eigen::Lower>();
      const Eigen::MatrixXd expected = lower.solve(A.transpose()).transpose();
      double error = 0;
      for (int k = 0; k < rank; ++k)
        for (int i = 0; i < round_up_to_panel(n); ++i) {
          const double w = W.data()[panel_index(i, k, rank)];
          error = std::max(error, std::abs(w - (i < n ? expected(i, k) : 0)));
        }
      ASSERT_LE(error, 1e-12 * expected.cwiseAbs().maxCoeff()) << path.name << " n " << n << " rank " << rank;
    }
}

TEST(Cholesky, EqualsEigen) {
  RandomStream random(5, "cholesky");
  for (const int n : {1, 2, 7, 8, 63, 64, 65, 71, 128, 130, 200, 333}) {
    const int stride = round_up_to_panel(n) + 8;
    const Eigen::MatrixXd S = random_covariance(random, n);
    AlignedBuffer storage(static_cast<std::size_t>(stride) * n), workspace(cholesky_workspace(n));
    std::fill_n(storage.data(), storage.size(), untouched);
    Eigen::Map<Eigen::MatrixXd, 0, Eigen::OuterStride<>> L(storage.data(), n, n,
                                                           Eigen::OuterStride<>(stride));
    L.triangularView<Eigen::Lower>() = S;
    ASSERT_TRUE(cholesky(storage.data(), stride, n, workspace.data()));
    const Eigen::MatrixXd expected = S.llt().matrixL(), got = L.triangularView<Eigen::Lower>();
    ASSERT_TRUE(close(got, expected, 1e-10)) << n;
    // For a negative pivot at the beginning, in the middle and at the end
    for (const int bad : {0, n / 2, n - 1}) {
      L.triangularView<Eigen::Lower>() = S;
      L(bad, bad) = expected.row(bad).head(bad).squaredNorm() - 1e-3;
      EXPECT_FALSE(cholesky(storage.data(), stride, n, workspace.data())) << n << " at " << bad;
    }
  }
}

TEST(RankUpdate, WritesOnlyItsTiles) {
  RandomStream random(2, "beside");
  for (const RankUpdatePath& path : rank_update_paths())
    for (int n = 1; n <= 40; ++n) {
      Problem problem(random, n, 5);
      path.run(problem.storage.data(), problem.stride, n, problem.packed.data(), 5);
      for (int j = 0; j < n + 3; ++j)
        for (int i = 0; i < problem.stride; ++i) {
          const bool mine = j < n && i >= j / 8 * 8 && i < n;
          if (!mine) {
            ASSERT_EQ(problem.at(i, j), i < n && j < n ? problem.P(i, j) : untouched)
                << path.name << " n " << n;
          }
        }
    }
}

TEST(RankUpdate, TheBestPathIsInUseAndTheBaselineIsAlwaysAvailable) {
  ASSERT_FALSE(rank_update_paths().empty());
  EXPECT_EQ(std::string(rank_update_path()), rank_update_paths().front().name);
  EXPECT_EQ(std::string(rank_update_paths().back().name), "baseline");
}

TEST(RankUpdate, APathIsDeterministic) {
  for (const RankUpdatePath& path : rank_update_paths()) {
    RandomStream a(3, "bytes"), b(3, "bytes");
    Problem first(a, 67, 24), second(b, 67, 24);
    path.run(first.storage.data(), first.stride, 67, first.packed.data(), 24);
    path.run(second.storage.data(), second.stride, 67, second.packed.data(), 24);
    EXPECT_TRUE(
        std::equal(first.storage.data(), first.storage.data() + first.storage.size(), second.storage.data()));
  }
}

}  // namespace
}  // namespace incognita::testing
