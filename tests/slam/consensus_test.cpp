#include "incognita/slam/features/consensus.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "incognita/math/gaussian.hpp"
#include "incognita/math/random.hpp"

namespace incognita {
namespace {

const double gate = chi_square_quantile(0.99, 2);

/// Innovations as a camera of unknown pose makes them: far larger together than one against the other.
struct Frame {
  Eigen::VectorXd residuals;
  Eigen::MatrixXd S;
};

Frame frame(int matches, RandomStream& random) {
  const int rows = 2 * matches;
  Eigen::MatrixXd H(rows, 6);
  for (int i = 0; i < H.size(); ++i) H(i) = 5 * random.normal();
  Eigen::VectorXd camera(6), noise(rows);
  for (int i = 0; i < 6; ++i) camera[i] = std::clamp(random.normal(), -1.0, 1.0);
  for (int i = 0; i < rows; ++i) noise[i] = std::clamp(random.normal(), -1.0, 1.0);
  return {H * camera + noise, H * H.transpose() + Eigen::MatrixXd::Identity(rows, rows)};
}

TEST(Consensus, ConsistentMatchesAreAllTaken) {
  RandomStream random(1, "consensus");
  for (int trial = 0; trial < 50; ++trial) {
    const Frame f = frame(12, random);
    EXPECT_EQ(consistent_matches(f.residuals, f.S, gate), std::vector<bool>(12, true));
  }
}

TEST(Consensus, OutliersAreRejected) {
  RandomStream random(2, "consensus");
  for (int trial = 0; trial < 50; ++trial) {
    Frame f = frame(12, random);
    // well inside its own gate, which is tens of pixels: only the other matches contradict it
    for (const int i : {3, 8}) f.residuals[2 * i + random.below(2)] += random.below(2) ? 12 : -12;
    std::vector<bool> wanted(12, true);
    wanted[3] = wanted[8] = false;
    EXPECT_EQ(consistent_matches(f.residuals, f.S, gate), wanted) << "trial " << trial;
  }
}

TEST(Consensus, ASingleMatchIsTestedByItsOwnGate) {
  Eigen::Matrix2d S;
  S << 9, 3, 3, 4;
  const Eigen::Vector2d direction(1, 2);
  const double unit = std::sqrt(gate / direction.dot(S.inverse() * direction));
  EXPECT_EQ(consistent_matches(0.99 * unit * direction, S, gate), std::vector<bool>{true});
  EXPECT_EQ(consistent_matches(1.01 * unit * direction, S, gate), std::vector<bool>{false});
}

TEST(Consensus, OfMatchesThatAllDisagreeAtMostOneIsTaken) {
  // a shift of all by some 20 px is expected, no difference beyond a pixel is; these point everywhere
  constexpr int n = 8;
  Eigen::MatrixXd S = Eigen::MatrixXd::Identity(2 * n, 2 * n);
  Eigen::VectorXd residuals(2 * n);
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) S.block<2, 2>(2 * i, 2 * j) += 400 * Eigen::Matrix2d::Identity();
    residuals.segment<2>(2 * i) =
        30 * Eigen::Vector2d(std::cos(2 * M_PI * i / n), std::sin(2 * M_PI * i / n));
  }
  const auto agrees = consistent_matches(residuals, S, gate);
  EXPECT_LE(std::count(agrees.begin(), agrees.end(), true), 1);
  EXPECT_EQ(consistent_matches(10 * residuals, S, gate), std::vector<bool>(n, false)) << "not even alone";
}

/// Innovations of a frame in which `returning` landmarks come back after a drift that none of the `recent`
/// knows: 30 px together, a pixel one against the other.
Frame loop_closing(int recent, int returning) {
  const int rows = 2 * (recent + returning);
  Frame f{Eigen::VectorXd::Zero(rows), Eigen::MatrixXd::Identity(rows, rows)};
  for (int i = recent; i < recent + returning; ++i) {
    f.residuals.segment<2>(2 * i) << 20, -10;
    for (int j = recent; j < recent + returning; ++j)
      f.S.block<2, 2>(2 * i, 2 * j) += 900 * Eigen::Matrix2d::Identity();
  }
  return f;
}

std::vector<bool> last(int of, int returning) {
  std::vector<bool> which(static_cast<std::size_t>(of), false);
  std::fill(which.end() - returning, which.end(), true);
  return which;
}

TEST(Consensus, AReturningMatchAloneIsUnconfirmed) {
  const Frame one = loop_closing(6, 1), two = loop_closing(6, 2);
  const std::vector<bool> all(7, true), none(7, false);
  EXPECT_EQ(consistent_matches(one.residuals, one.S, gate), all) << "no other match contradicts it";
  EXPECT_EQ(unconfirmed_matches(one.S, all, last(7, 1), 8), last(7, 1)) << "and none confirms it";
  EXPECT_EQ(unconfirmed_matches(one.S, all, last(7, 1), 31), none) << "near enough by itself";
  EXPECT_EQ(unconfirmed_matches(one.S, all, none, 8), none) << "one that was just initialized";
  EXPECT_EQ(unconfirmed_matches(two.S, std::vector<bool>(8, true), last(8, 2), 8),
            std::vector<bool>(8, false))
      << "two that return confirm each other";
}

TEST(Consensus, TwoReturningMatchesThatDisagreeAreUnconfirmed) {
  Frame f = loop_closing(6, 2);
  f.residuals.tail<2>() << -20, 10;
  const std::vector<bool> agrees = consistent_matches(f.residuals, f.S, gate);
  const std::vector<bool> alone = unconfirmed_matches(f.S, agrees, last(8, 2), 8);
  for (std::size_t i = 6; i < 8; ++i) EXPECT_FALSE(agrees[i] && !alone[i]) << i;
  for (std::size_t i = 0; i < 6; ++i) EXPECT_TRUE(agrees[i] && !alone[i]) << i;
}

/// Along one axis: beside the other's its information is lost in rounding.
TEST(Consensus, AMatchWithoutInformationAlongOneAxisIsUnconfirmed) {
  const Eigen::Matrix2d S = Eigen::Vector2d(1, 1e20).asDiagonal();
  const std::vector<bool> yes{true}, no{false};
  EXPECT_EQ(unconfirmed_matches(S, yes, yes, 1e9), yes);
  EXPECT_EQ(unconfirmed_matches(S, no, yes, 8), no) << "it is none of those that agree";
}

TEST(Consensus, NoMatchesAgreeOnNothing) {
  EXPECT_TRUE(consistent_matches(Eigen::VectorXd(0), Eigen::MatrixXd(0, 0), gate).empty());
}

}  // namespace
}  // namespace incognita
