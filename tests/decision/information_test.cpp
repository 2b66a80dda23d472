// Mutual information in measurement space against the thesis' determinants of the whole covariance, (6.6).
#include "incognita/decision/information.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <vector>

#include "incognita/math/gaussian.hpp"
#include "incognita/math/random.hpp"

namespace incognita {
namespace {

Eigen::MatrixXd random_matrix(RandomStream& random, int rows, int columns) {
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return random.normal(); });
}

Eigen::MatrixXd random_covariance(RandomStream& random, int size) {
  const Eigen::MatrixXd a = random_matrix(random, size, size + 3);
  return a * a.transpose() / size + 0.01 * Eigen::MatrixXd::Identity(size, size);
}

struct SmallMap {
  Belief belief;
  BlockId vehicle = 0;
  std::vector<BlockId> landmarks;
};

SmallMap small_map(RandomStream& random, int landmarks) {
  SmallMap map;
  map.vehicle =
      map.belief.add_vehicle(Chart::line(12), Eigen::VectorXd::Zero(12), random_covariance(random, 12));
  for (int i = 0; i < landmarks; ++i) {
    const Belief::Parent parent{map.vehicle, random_matrix(random, 3, 12)};
    map.landmarks.push_back(map.belief.augment(Chart::line(3), Eigen::VectorXd::Zero(3), {&parent, 1},
                                               random_covariance(random, 3)));
  }
  return map;
}

std::vector<AffineLook> random_looks(RandomStream& random, const SmallMap& map, bool with_anchor) {
  std::vector<AffineLook> looks;
  for (const BlockId id : map.landmarks) {
    AffineLook look;
    look.add(map.vehicle, random_matrix(random, 2, 12));
    look.add(id, random_matrix(random, 2, 3));
    look.residual = Eigen::Vector2d::Zero();
    look.R = random_covariance(random, 2);
    looks.push_back(look);
  }
  if (with_anchor) {
    AffineLook look;
    look.add(map.vehicle, random_matrix(random, 2, 12));
    look.residual = Eigen::Vector2d::Zero();
    look.R = random_covariance(random, 2);
    looks.push_back(look);
  }
  return looks;
}

/// (log|P before| - log|P after|)/2 with the textbook posterior: the thesis' way.
double by_determinants(const SmallMap& map, const ImaginedMotion& motion,
                       const std::vector<AffineLook>& looks) {
  const int n = map.belief.errors();
  Eigen::MatrixXd F = Eigen::MatrixXd::Identity(n, n), P = map.belief.dense_covariance();
  F.topLeftCorner(12, 12) = motion.A;
  P = F * P * F.transpose();
  P.topLeftCorner(12, 12) += motion.N;
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(2 * static_cast<int>(looks.size()), n);
  Eigen::MatrixXd R = Eigen::MatrixXd::Zero(H.rows(), H.rows());
  for (std::size_t i = 0; i < looks.size(); ++i) {
    for (int k = 0; k < looks[i].part_count; ++k) {
      const auto& part = looks[i].parts[k];
      H.block(2 * i, map.belief.offset(part.block), 2, part.H.cols()) = part.H;
    }
    R.block<2, 2>(2 * i, 2 * i) = looks[i].R;
  }
  const Eigen::MatrixXd S = H * P * H.transpose() + R;
  const Eigen::MatrixXd posterior = P - P * H.transpose() * S.inverse() * H * P;
  return 0.5 * (std::log(P.determinant()) - std::log(posterior.determinant()));
}

TEST(MutualInformation, EqualsTheThesisDeterminants) {
  RandomStream random(1, "test.information");
  for (int round = 0; round < 50; ++round) {
    const SmallMap map = small_map(random, 1 + random.below(4));
    const ImaginedMotion motion{map.vehicle, random_matrix(random, 12, 12), random_covariance(random, 12)};
    const auto looks = random_looks(random, map, round % 2 == 0);
    MutualInformation information;
    const double ours = information(map.belief, motion, looks);
    const double theirs = by_determinants(map, motion, looks);
    EXPECT_NEAR(ours, theirs, 1e-6 * (1 + std::abs(theirs))) << "round " << round;
    EXPECT_GT(ours, 0);
  }
}

TEST(MutualInformation, NoLooksTeachNothingAndMoreLooksTeachMore) {
  RandomStream random(2, "test.information");
  const SmallMap map = small_map(random, 5);
  const ImaginedMotion motion{map.vehicle, Eigen::MatrixXd::Identity(12, 12), random_covariance(random, 12)};
  const auto looks = random_looks(random, map, true);
  MutualInformation information;
  double before = 0;
  EXPECT_EQ(information(map.belief, motion, {}), 0);
  for (std::size_t count = 1; count <= looks.size(); ++count) {
    const double now = information(map.belief, motion, {looks.data(), count});
    EXPECT_GT(now, before);
    before = now;
  }
}

TEST(MutualInformation, SurvivesWhereDeterminantsUnderflow) {
  // |1e-4 I| of 313 states is 0 in double: the thesis' way gives no number at all, this one does
  SmallMap map;
  map.vehicle = map.belief.add_vehicle(Chart::line(12), Eigen::VectorXd::Zero(12),
                                       1e-4 * Eigen::MatrixXd::Identity(12, 12));
  for (int i = 0; i < 101; ++i)
    map.landmarks.push_back(map.belief.augment(Chart::line(3), Eigen::VectorXd::Zero(3), {},
                                               1e-4 * Eigen::MatrixXd::Identity(3, 3)));
  ASSERT_EQ(map.belief.dense_covariance().determinant(), 0);
  RandomStream random(3, "test.information");
  const auto looks = random_looks(random, map, false);
  const ImaginedMotion still{map.vehicle, Eigen::MatrixXd::Identity(12, 12), Eigen::MatrixXd::Zero(12, 12)};
  MutualInformation information;
  Belief updated = map.belief;
  const double ours = information(map.belief, still, looks);
  const UpdateReport report = updated.update(looks);
  EXPECT_NEAR(ours, 0.5 * (report.log_det_S - report.log_det_R), 1e-9);
  EXPECT_NEAR(ours, 0.5 * (log_det(map.belief.dense_covariance()) - log_det(updated.dense_covariance())),
              1e-6);
}

}  // namespace
}  // namespace incognita
