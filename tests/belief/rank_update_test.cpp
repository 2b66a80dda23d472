// Every build of the inner loop against Eigen's.
#include "incognita/belief/rank_update.hpp"

#include <string>

#include "incognita/belief/aligned_buffer.hpp"
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
      for (int k = 0; k < rank; ++k) packed.data()[(i / 8) * 8 * rank + k * 8 + i % 8] = W(i, k);
  }
  double at(int i, int j) const { return storage.data()[i + static_cast<long>(j) * stride]; }
};

TEST(RankUpdate, EveryPathIsEigens) {
  RandomStream random(1, "rank");
  for (const RankUpdatePath& path : rank_update_paths())
    for (int n = 1; n <= 70; ++n)
      for (int rank = 1; rank <= 30; ++rank) {
        Problem problem(random, n, rank);
        path.run(problem.storage.data(), problem.stride, n, problem.packed.data(), rank);
        Eigen::MatrixXd expected = problem.P;
        expected.selfadjointView<Eigen::Lower>().rankUpdate(problem.W, -1.0);
        double error = 0;
        for (int j = 0; j < n; ++j)
          for (int i = j; i < n; ++i) error = std::max(error, std::abs(problem.at(i, j) - expected(i, j)));
        ASSERT_LE(error, 1e-12 * expected.cwiseAbs().maxCoeff())
            << path.name << " n " << n << " rank " << rank;
      }
}

TEST(Whiten, OnEveryPathIsEigensTriangularSolve) {
  RandomStream random(4, "whiten");
  for (const RankUpdatePath& path : rank_update_paths())
    for (int n = 1; n <= 40; ++n)
      for (int rank = 1; rank <= 30; rank += 3) {
        const int stride = round_up_to_panel(n) + 8;
        Eigen::MatrixXd A = random_matrix(random, n, rank), L = random_matrix(random, rank + 2, rank);
        L.diagonal().array() += 5;
        AlignedBuffer padded(static_cast<std::size_t>(stride) * rank);
        for (int k = 0; k < rank; ++k)
          std::copy_n(A.col(k).data(), n, padded.data() + static_cast<long>(k) * stride);
        AlignedBuffer W(static_cast<std::size_t>(round_up_to_panel(n)) * rank);
        std::fill_n(W.data(), W.size(), untouched);
        path.whiten(padded.data(), stride, n, L.data(), rank + 2, rank, W.data());
        const auto lower = L.topRows(rank).triangularView<Eigen::Lower>();
        const Eigen::MatrixXd expected = lower.solve(A.transpose()).transpose();
        double error = 0;
        for (int k = 0; k < rank; ++k)
          for (int i = 0; i < round_up_to_panel(n); ++i) {
            const double w = W.data()[(i / 8) * 8 * rank + k * 8 + i % 8];
            error = std::max(error, std::abs(w - (i < n ? expected(i, k) : 0)));
          }
        ASSERT_LE(error, 1e-12 * expected.cwiseAbs().maxCoeff())
            << path.name << " n " << n << " rank " << rank;
      }
}

TEST(RankUpdate, WritesNowhereBesideItsTiles) {
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

TEST(RankUpdate, TheBestPathIsInUseAndTheBaselineIsAlwaysThere) {
  ASSERT_FALSE(rank_update_paths().empty());
  EXPECT_EQ(std::string(rank_update_path()), rank_update_paths().front().name);
  EXPECT_EQ(std::string(rank_update_paths().back().name), "baseline");
}

TEST(RankUpdate, TheSamePathAlwaysGivesTheSameBytes) {
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
