// Blocks added, replaced and dropped: covariance, means and ids.
#include "tests/belief/dense.hpp"

namespace incognita::testing {
namespace {

/// P without some rows and columns.
Eigen::MatrixXd without(const Eigen::MatrixXd& P, int first, int count) {
  std::vector<int> kept;
  for (int i = 0; i < P.rows(); ++i)
    if (i < first || i >= first + count) kept.push_back(i);
  return P(kept, kept);
}

TEST(Augment, EqualsTheDenseJacobian) {
  RandomStream random(1, "augment");
  for (int run = 0; run < 60; ++run) {
    Map map(random, {6, 1 + random.below(16)}, std::vector<int>(random.below(30), 3));
    const int size = 1 + random.below(6), old = map.belief.errors();
    std::vector<Belief::Parent> parents;
    Eigen::MatrixXd G = Eigen::MatrixXd::Zero(old + size, old);  // errors before -> errors after (2.23)
    G.topRows(old).setIdentity();
    // no parent: an independent prior; a block may be a parent twice
    for (int i = random.below(4); i > 0; --i) {
      const BlockId id = random.below(map.belief.block_count());
      parents.push_back({id, random_matrix(random, size, map.belief.chart(id).tangent())});
      G.block(old, map.belief.offset(id), size, map.belief.chart(id).tangent()) += parents.back().J;
    }
    const Eigen::MatrixXd noise = random_covariance(random, size), P = map.belief.dense_covariance();
    Eigen::MatrixXd expected = G * P * G.transpose();
    expected.bottomRightCorner(size, size) += noise;
    const Eigen::VectorXd mean = random_matrix(random, size, 1);
    const BlockId id = map.belief.augment(Chart::line(size), mean, parents, noise);
    ASSERT_TRUE(close(map.belief.dense_covariance(), expected, 1e-13));
    EXPECT_EQ(map.belief.mean(id), mean);
    EXPECT_EQ(map.belief.offset(id), old);
  }
}

TEST(Augment, AcceptsAMeanInsideTheBelief) {
  Belief belief(1);  // so small that it must reallocate while copying
  BlockId last = belief.add_vehicle(Chart::line(3), Eigen::Vector3d(1, 2, 3), Eigen::Matrix3d::Identity());
  for (int i = 0; i < 50; ++i)
    last = belief.augment(Chart::line(3), belief.mean(last), {}, Eigen::Matrix3d::Identity());
  EXPECT_EQ(belief.mean(last), Eigen::Vector3d(1, 2, 3));
}

TEST(AddVehicle, IsIndependentEvenInMemoryOfADroppedLandmark) {
  RandomStream random(2, "vehicles");
  Map map(random, {3}, {3, 3});
  const Eigen::MatrixXd first = map.belief.covariance(map.vehicles[0]);
  map.belief.drop(map.landmarks[0]);
  map.belief.drop(map.landmarks[1]);  // values left in memory must not reappear
  const Eigen::MatrixXd P = random_covariance(random, 4);
  const BlockId second = map.belief.add_vehicle(Chart::line(4), Eigen::Vector4d::Ones(), P);
  EXPECT_EQ(map.belief.covariance(second), P);
  EXPECT_EQ(map.belief.covariance(map.vehicles[0]), first);
  EXPECT_EQ(map.belief.covariance(map.vehicles[0], second), BlockMatrix::Zero(3, 4));
}

TEST(Replace, EqualsTheDenseJacobianForFewerErrorsToo) {
  RandomStream random(3, "replace");
  for (int run = 0; run < 60; ++run) {
    Map map(random, {6, 2}, {6, 3, 6, 1, 6});
    const BlockId id = map.landmarks[2 * random.below(3)];  // first, middle, last
    const int size = run % 2 == 0 ? 3 : 6, first = map.belief.offset(id), n = map.belief.errors();
    const Eigen::MatrixXd J = random_matrix(random, size, 6), noise = random_covariance(random, size);
    Eigen::MatrixXd G = Eigen::MatrixXd::Zero(n - 6 + size, n);
    G.topLeftCorner(first, first).setIdentity();
    G.block(first, first, size, 6) = J;
    G.bottomRightCorner(n - first - 6, n - first - 6).setIdentity();
    Eigen::MatrixXd expected = G * map.belief.dense_covariance() * G.transpose();
    expected.block(first, first, size, size) += noise;
    std::vector<Eigen::VectorXd> others;
    for (const BlockId other : map.landmarks) others.push_back(map.belief.mean(other));
    const Eigen::VectorXd mean = random_matrix(random, size, 1);
    map.belief.replace(id, Chart::line(size), mean, J, noise);
    ASSERT_TRUE(close(map.belief.dense_covariance(), expected, 1e-13));
    for (std::size_t i = 0; i < others.size(); ++i)
      EXPECT_EQ(map.belief.mean(map.landmarks[i]), map.landmarks[i] == id ? mean : others[i]);
  }
}

TEST(Replace, AcceptsTheMeanOfTheReplacedBlock) {
  RandomStream random(4, "alias");
  Map map(random, {3}, {6, 3});
  const Eigen::VectorXd mean = map.belief.mean(map.landmarks[0]).tail(3),
                        next = map.belief.mean(map.landmarks[1]);
  map.belief.replace(map.landmarks[0], Chart::line(3), map.belief.mean(map.landmarks[0]).tail(3),
                     BlockMatrix::Identity(3, 6), BlockMatrix::Zero(3, 3));
  EXPECT_EQ(map.belief.mean(map.landmarks[0]), mean);
  EXPECT_EQ(map.belief.mean(map.landmarks[1]), next);
}

TEST(Drop, RemovesItsRowsAndColumnsOnly) {
  RandomStream random(5, "drop");
  for (int which = 0; which < 7; ++which) {
    Map map(random, {4, 2}, {3, 6, 1, 3, 2});
    const BlockId id = which;
    const Eigen::MatrixXd expected =
        without(map.belief.dense_covariance(), map.belief.offset(id), map.belief.chart(id).tangent());
    std::vector<Eigen::VectorXd> means;
    for (BlockId other = 0; other < 7; ++other) means.push_back(map.belief.mean(other));
    map.belief.drop(id);
    EXPECT_EQ(map.belief.dense_covariance(), expected);
    EXPECT_FALSE(map.belief.has(id));
    int errors = 0;
    for (BlockId other = 0; other < 7; ++other) {
      if (other == id) continue;
      EXPECT_EQ(map.belief.mean(other), means[other]);
      EXPECT_EQ(map.belief.offset(other), errors);
      errors += map.belief.chart(other).tangent();
    }
    EXPECT_EQ(map.belief.errors(), errors);
  }
}

TEST(Ids, AreNeverReused) {
  RandomStream random(6, "ids");
  Map map(random, {3}, {3, 3});
  const BlockId last = map.landmarks.back();
  map.belief.drop(last);
  const BlockId next =
      map.belief.augment(Chart::line(1), Eigen::VectorXd::Zero(1), {}, Eigen::MatrixXd::Ones(1, 1));
  EXPECT_EQ(next, last + 1);
  EXPECT_FALSE(map.belief.has(last));
  EXPECT_THROW(map.belief.mean(last), std::invalid_argument);
}

TEST(Covariance, BetweenTwoBlocksIsTransposedWhenSwapped) {
  RandomStream random(7, "cross");
  Map map(random, {4}, {3, 2});
  const BlockMatrix a = map.belief.covariance(map.landmarks[1], map.vehicles[0]);
  EXPECT_EQ(a.rows(), 2);
  EXPECT_EQ(a.cols(), 4);
  EXPECT_EQ(a, map.belief.covariance(map.vehicles[0], map.landmarks[1]).transpose());
  EXPECT_EQ(a, map.belief.dense_covariance().block(7, 0, 2, 4));
}

TEST(Copy, IsIndependentOfTheOriginal) {
  RandomStream random(8, "copy");
  Map map(random, {3}, {3, 3});
  const std::vector<BlockId> ids = {map.vehicles[0], map.landmarks[0], map.landmarks[1]};
  const Photograph before(map.belief, ids);
  Belief copy = map.belief;
  const LinearizedMeasurement measurement =
      random_measurement(random, copy, 2, {map.vehicles[0], map.landmarks[1]});
  copy.update({&measurement, 1});
  EXPECT_TRUE(Photograph(map.belief, ids) == before);
  map.belief.update({&measurement, 1});
  EXPECT_TRUE(Photograph(map.belief, ids) == Photograph(copy, ids));  // the same bytes
  EXPECT_FALSE(Photograph(map.belief, ids) == before);
}

}  // namespace
}  // namespace incognita::testing
