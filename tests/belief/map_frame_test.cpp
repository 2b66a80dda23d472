// Operations on every block at once, and the block-diagonal map.
#include <Eigen/Eigenvalues>

#include "tests/belief/dense.hpp"

namespace incognita::testing {
namespace {

double least_eigenvalue(const Eigen::MatrixXd& M) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(M).eigenvalues()[0];
}

TEST(Correction, EqualsWhatTheUpdateAdds) {
  RandomStream random(1, "correction");
  for (int run = 0; run < 50; ++run) {
    Map map(random, {3}, {2, 2, 1, 3});
    const std::vector<BlockId> ids{map.vehicles[0], map.landmarks[0], map.landmarks[1], map.landmarks[2],
                                   map.landmarks[3]};
    const std::vector<LinearizedMeasurement> measurements{
        random_measurement(random, map.belief, 2, {ids[0], ids[1]}),
        random_measurement(random, map.belief, 1, {ids[0], ids[4]})};
    const Eigen::VectorXd before = stacked_mean(map.belief, ids);
    const Photograph untouched(map.belief, ids);
    std::vector<BlockVector> added(ids.size());
    ASSERT_TRUE(map.belief.correction(measurements, ids, added));
    EXPECT_TRUE(Photograph(map.belief, ids) == untouched);
    map.belief.update(measurements);
    const Eigen::VectorXd moved = stacked_mean(map.belief, ids) - before;
    for (std::size_t i = 0; i < ids.size(); ++i)
      EXPECT_TRUE(close(added[i], moved.segment(map.belief.offset(ids[i]), added[i].size()), 1e-10));
  }
}

TEST(ChangeFrame, EqualsTheDenseProduct) {
  RandomStream random(2, "carry");
  for (int run = 0; run < 50; ++run) {
    Map map(random, {3, 2}, {2, 1, 3});
    // one stays unchanged
    const std::vector<BlockId> ids{map.vehicles[1], map.landmarks[0], map.landmarks[2]};
    const BlockId frame_motion = map.vehicles[0];
    const int n = map.belief.errors();
    Eigen::MatrixXd T = Eigen::MatrixXd::Identity(n, n);
    std::vector<Belief::MovedBlock> carried;
    for (const BlockId id : ids) {
      const int size = map.belief.chart(id).tangent(), at = map.belief.offset(id);
      carried.push_back({id, random_matrix(random, size, 1), random_matrix(random, size, size),
                         random_matrix(random, size, 3)});
      T.block(at, at, size, size) = carried.back().A;
      T.block(at, map.belief.offset(frame_motion), size, 3) = carried.back().B;
    }
    const LinearizedMotion motion{frame_motion, random_matrix(random, 3, 1), random_matrix(random, 3, 3),
                                  random_covariance(random, 3)};
    T.block(0, 0, 3, 3) = motion.A;
    const Eigen::MatrixXd P = map.belief.dense_covariance();
    Eigen::MatrixXd expected = T * P * T.transpose();
    expected.topLeftCorner(3, 3) += motion.N;
    map.belief.change_frame(motion, carried);
    EXPECT_TRUE(close(map.belief.dense_covariance(), expected, 1e-11));
    EXPECT_TRUE(close(map.belief.mean(ids[1]), carried[1].x_next, 0));
    EXPECT_TRUE(close(map.belief.mean(frame_motion), motion.x_next, 0));
  }
}

TEST(Shear, EqualsTheDenseProduct) {
  RandomStream random(12, "shear");
  for (int run = 0; run < 50; ++run) {
    Map map(random, {3, 5}, {2, 1, 3, 6});
    const BlockId vehicle = map.vehicles[1];
    const int n = map.belief.errors(), at = map.belief.offset(vehicle) + 2;
    Eigen::MatrixXd T = Eigen::MatrixXd::Identity(n, n);
    std::vector<ErrorShear> shears;
    for (const BlockId id : {map.landmarks[3], map.landmarks[0]}) {  // in any order, not all
      const int size = map.belief.chart(id).tangent();
      shears.push_back({id, random_matrix(random, size, 3)});
      T.block(map.belief.offset(id), at, size, 3) = shears.back().B;
    }
    const Eigen::MatrixXd expected = T * map.belief.dense_covariance() * T.transpose();
    const Eigen::VectorXd mean = map.belief.mean(map.landmarks[3]);
    map.belief.shear(vehicle, 2, shears);
    EXPECT_TRUE(close(map.belief.dense_covariance(), expected, 1e-11));
    EXPECT_TRUE(close(map.belief.mean(map.landmarks[3]), mean, 0));
  }
}

TEST(Shear, OfAWholeVehicleAndInParts) {
  RandomStream random(14, "wide");
  Map map(random, {12}, {3, 6});
  const Eigen::MatrixXd P = map.belief.dense_covariance();
  Eigen::MatrixXd T = Eigen::MatrixXd::Identity(P.rows(), P.cols());
  std::vector<ErrorShear> shears;
  for (int part = 0; part < 2; ++part) {  // twice the same landmark
    shears.push_back({map.landmarks[1], random_matrix(random, 6, 12)});
    T.block(map.belief.offset(map.landmarks[1]), 0, 6, 12) += shears.back().B;
  }
  map.belief.shear(map.vehicles[0], 0, shears);
  EXPECT_TRUE(close(map.belief.dense_covariance(), T * P * T.transpose(), 1e-11));
}

TEST(Shear, RefusesWrongSizesAndVehicles) {
  RandomStream random(13, "misfit");
  Map map(random, {3, 3}, {2});
  const Eigen::MatrixXd before = map.belief.dense_covariance();
  const auto refuses = [&](BlockId vehicle, int first, BlockId landmark, int rows, int columns) {
    const ErrorShear shear{landmark, Eigen::MatrixXd::Ones(rows, columns)};
    EXPECT_THROW(map.belief.shear(vehicle, first, {&shear, 1}), std::invalid_argument);
  };
  refuses(map.vehicles[0], 1, map.landmarks[0], 2, 3);  // the vehicle has three errors
  refuses(map.vehicles[0], -1, map.landmarks[0], 2, 1);
  refuses(map.vehicles[0], 0, map.landmarks[0], 3, 3);  // the landmark two
  refuses(map.vehicles[1], 0, map.vehicles[0], 3, 3);
  refuses(map.vehicles[1], 0, map.vehicles[1], 3, 3);
  EXPECT_TRUE(close(map.belief.dense_covariance(), before, 0));
}

TEST(ChangeFrame, RefusesWrongSizes) {
  RandomStream random(3, "misfit");
  Map map(random, {3}, {2});
  const LinearizedMotion motion{map.vehicles[0], Eigen::Vector3d::Zero(), Eigen::Matrix3d::Zero(),
                                Eigen::Matrix3d::Zero()};
  const Belief::MovedBlock wrong{map.landmarks[0], Eigen::Vector2d::Zero(), Eigen::Matrix2d::Identity(),
                                 Eigen::Matrix2d::Identity()};
  EXPECT_THROW(map.belief.change_frame(motion, {&wrong, 1}), std::invalid_argument);
}

TEST(Decorrelate, MapKeepsTheVehicleAndInflatesTheRest) {
  RandomStream random(4, "decorrelate");
  for (int run = 0; run < 20; ++run) {
    Map map(random, {3}, {2, 2, 2, 1});
    const Eigen::MatrixXd P = map.belief.dense_covariance();
    map.belief.decorrelate(Belief::Scope::map);
    const Eigen::MatrixXd inflated = map.belief.dense_covariance();
    EXPECT_TRUE(close(inflated.topRows(3), P.topRows(3), 0));
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < i; ++j)
        EXPECT_TRUE(map.belief.covariance(map.landmarks[i], map.landmarks[j]).isZero(0));
    EXPECT_GE(least_eigenvalue(inflated - P), -1e-9 * P.norm());
  }
}

TEST(Decorrelate, AllBlocksAreUncorrelated) {
  RandomStream random(5, "everything");
  Map map(random, {3}, {2, 2});
  const Eigen::MatrixXd P = map.belief.dense_covariance();
  map.belief.decorrelate(Belief::Scope::everything);
  const Eigen::MatrixXd inflated = map.belief.dense_covariance();
  EXPECT_TRUE(inflated.bottomLeftCorner(4, 3).isZero(0));
  EXPECT_TRUE(inflated.bottomLeftCorner(2, 2 + 3).isZero(0));
  EXPECT_GE(least_eigenvalue(inflated - P), -1e-9 * P.norm());
}

/// A vehicle and landmarks initialized from it, in a belief with a block-diagonal map and in one with a full
/// covariance.
struct BothMaps {
  Belief full{64}, block_diagonal{64, MapCorrelations::block_diagonal};
  std::vector<BlockId> landmarks;
  explicit BothMaps(RandomStream& random, int count) {
    const Eigen::MatrixXd P = random_covariance(random, 3);
    for (Belief* b : {&full, &block_diagonal}) b->add_vehicle(Chart::line(3), Eigen::Vector3d::Zero(), P);
    for (int i = 0; i < count; ++i) {
      const Belief::Parent parent{0, random_matrix(random, 2, 3)};
      const Eigen::MatrixXd noise = random_covariance(random, 2);
      for (Belief* b : {&full, &block_diagonal})
        landmarks.push_back(b->augment(Chart::line(2), Eigen::Vector2d::Zero(), {&parent, 1}, noise));
      landmarks.pop_back();
    }
  }
};

TEST(BlockDiagonalMap, IsNeverMoreConfidentThanTheFullFilter) {
  RandomStream random(6, "dropped");
  for (int run = 0; run < 20; ++run) {
    BothMaps both(random, 1 + random.below(6));
    for (int step = 0; step < 30; ++step) {
      // From the same covariance, one update of either kind: the block-diagonal posterior must not be smaller
      const LinearizedMeasurement measurement = random_measurement(
          random, both.block_diagonal, 1 + random.below(2),
          {0,
           both.landmarks[static_cast<std::size_t>(random.below(static_cast<int>(both.landmarks.size())))]});
      const Eigen::MatrixXd before = both.block_diagonal.dense_covariance();
      const Stacked stacked(both.block_diagonal, {&measurement, 1});
      const Posterior whole = textbook_update(before, stacked);
      ASSERT_EQ(both.block_diagonal.update({&measurement, 1}).outcome, UpdateReport::Outcome::updated);
      const Eigen::MatrixXd after = both.block_diagonal.dense_covariance();
      EXPECT_GE(least_eigenvalue(after - whole.P), -1e-9 * before.norm());
      EXPECT_TRUE(close(after.topRows(3), whole.P.topRows(3), 1e-9 * before.norm()));
      EXPECT_LE(after.trace(), before.trace() * (1 + 1e-12));
      EXPECT_TRUE(positive_definite(after));
      for (std::size_t i = 0; i < both.landmarks.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
          EXPECT_TRUE(both.block_diagonal.covariance(both.landmarks[i], both.landmarks[j]).isZero(0));
    }
  }
}

TEST(BlockDiagonalMap, InitializationInflatesByAtLeastTheCorrelations) {
  RandomStream random(7, "born apart");
  for (int run = 0; run < 20; ++run) {
    const BothMaps both(random, 1 + random.below(6));
    const Eigen::MatrixXd grown = both.block_diagonal.dense_covariance() - both.full.dense_covariance();
    EXPECT_GE(least_eigenvalue(grown), -1e-9 * both.full.dense_covariance().norm());
  }
}

TEST(BlockDiagonalMap, IsExactWithOneLandmark) {
  RandomStream random(8, "alone");
  BothMaps both(random, 1);
  for (int step = 0; step < 20; ++step) {
    const LinearizedMeasurement measurement =
        random_measurement(random, both.full, 2, {0, both.landmarks[0]});
    both.full.update({&measurement, 1});
    both.block_diagonal.update({&measurement, 1});
    EXPECT_TRUE(close(both.block_diagonal.dense_covariance(), both.full.dense_covariance(), 1e-9));
    EXPECT_TRUE(close(both.block_diagonal.mean(0), both.full.mean(0), 1e-9));
  }
}

/// With one landmark the map is exact: two sequential measurements equal two simultaneous ones.
TEST(BlockDiagonalMap, SequentialMeasurementsEqualSimultaneousOnes) {
  RandomStream random(10, "in turn");
  for (int run = 0; run < 20; ++run) {
    BothMaps both(random, 1);
    const std::vector<LinearizedMeasurement> measurements{
        random_measurement(random, both.full, 2, {0, both.landmarks[0]}),
        random_measurement(random, both.full, 1, {0}),
        random_measurement(random, both.full, 2, {0, both.landmarks[0]})};
    const UpdateReport a = both.full.update(measurements), b = both.block_diagonal.update(measurements);
    EXPECT_NEAR(a.nis, b.nis, 1e-9 * a.nis);
    EXPECT_TRUE(close(both.block_diagonal.dense_covariance(), both.full.dense_covariance(), 1e-9));
    EXPECT_TRUE(close(both.block_diagonal.mean(0), both.full.mean(0), 1e-9));
    EXPECT_TRUE(close(both.block_diagonal.mean(1), both.full.mean(1), 1e-9));
  }
}

TEST(BlockDiagonalMap, RefusesToLoseAVariance) {
  Belief belief(8, MapCorrelations::block_diagonal);
  belief.add_vehicle(Chart::line(2), Eigen::Vector2d::Zero(),
                     Eigen::Matrix2d(Eigen::Vector2d(1e18, 1.7e18).asDiagonal()));
  LinearizedMeasurement measurement;
  measurement.add(0, Eigen::Matrix2d::Identity());
  measurement.residual = Eigen::Vector2d::Zero();
  measurement.R = 0.01 * Eigen::Matrix2d::Identity();
  EXPECT_EQ(belief.update({&measurement, 1}).outcome, UpdateReport::Outcome::singular);
  EXPECT_EQ(belief.covariance(0)(0, 0), 1e18);
}

TEST(BlockDiagonalMap, RefusesOperationsThatCorrelateTheMap) {
  RandomStream random(11, "refused");
  BothMaps both(random, 2);
  const LinearizedMeasurement measurement =
      random_measurement(random, both.block_diagonal, 1, {0, both.landmarks[0]});
  std::vector<BlockVector> out(1);
  const BlockId ids[] = {0};
  EXPECT_THROW(both.block_diagonal.update_joseph({&measurement, 1}), std::logic_error);
  EXPECT_THROW(both.block_diagonal.correction({&measurement, 1}, ids, out), std::logic_error);
  EXPECT_THROW(both.block_diagonal.change_frame(
                   {0, Eigen::Vector3d::Zero(), Eigen::Matrix3d::Identity(), Eigen::Matrix3d::Zero()}, {}),
               std::logic_error);
  Belief two(8, MapCorrelations::block_diagonal);
  two.add_vehicle(Chart::line(1), Eigen::VectorXd::Zero(1), Eigen::MatrixXd::Identity(1, 1));
  EXPECT_THROW(two.add_vehicle(Chart::line(1), Eigen::VectorXd::Zero(1), Eigen::MatrixXd::Identity(1, 1)),
               std::logic_error);
}

TEST(BlockDiagonalMap, GainIsThatOfItsCovariance) {
  RandomStream random(9, "gain");
  BothMaps both(random, 4);
  const LinearizedMeasurement measurement =
      random_measurement(random, both.block_diagonal, 2, {0, both.landmarks[2]});
  const std::vector<BlockId> ids{0, both.landmarks[0], both.landmarks[1], both.landmarks[2],
                                 both.landmarks[3]};
  const Eigen::VectorXd before = stacked_mean(both.block_diagonal, ids);
  const Posterior whole = textbook_update(both.block_diagonal.dense_covariance(),
                                          Stacked(both.block_diagonal, {&measurement, 1}));
  both.block_diagonal.update({&measurement, 1});
  EXPECT_TRUE(close(stacked_mean(both.block_diagonal, ids) - before, whole.delta, 1e-9));
}

}  // namespace
}  // namespace incognita::testing
