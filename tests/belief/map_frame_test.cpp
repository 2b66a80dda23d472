// What changes every block at once, and the map whose correlations are dropped.
#include <Eigen/Eigenvalues>

#include "tests/belief/dense.hpp"

namespace incognita::testing {
namespace {

double least_eigenvalue(const Eigen::MatrixXd& M) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(M).eigenvalues()[0];
}

TEST(Correction, IsWhatTheUpdateAdds) {
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

TEST(Carry, IsTheDenseProduct) {
  RandomStream random(2, "carry");
  for (int run = 0; run < 50; ++run) {
    Map map(random, {3, 2}, {2, 1, 3});
    const std::vector<BlockId> ids{map.vehicles[1], map.landmarks[0], map.landmarks[2]};  // one stays
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

TEST(Carry, RefusesWhatDoesNotFit) {
  RandomStream random(3, "misfit");
  Map map(random, {3}, {2});
  const LinearizedMotion motion{map.vehicles[0], Eigen::Vector3d::Zero(), Eigen::Matrix3d::Zero(),
                                Eigen::Matrix3d::Zero()};
  const Belief::MovedBlock wrong{map.landmarks[0], Eigen::Vector2d::Zero(), Eigen::Matrix2d::Identity(),
                                 Eigen::Matrix2d::Identity()};
  EXPECT_THROW(map.belief.change_frame(motion, {&wrong, 1}), std::invalid_argument);
}

TEST(Decorrelate, MapKeepsTheVehicleAndGrowsTheRest) {
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

TEST(Decorrelate, EverythingIsBlockDiagonal) {
  RandomStream random(5, "everything");
  Map map(random, {3}, {2, 2});
  const Eigen::MatrixXd P = map.belief.dense_covariance();
  map.belief.decorrelate(Belief::Scope::everything);
  const Eigen::MatrixXd inflated = map.belief.dense_covariance();
  EXPECT_TRUE(inflated.bottomLeftCorner(4, 3).isZero(0));
  EXPECT_TRUE(inflated.bottomLeftCorner(2, 2 + 3).isZero(0));
  EXPECT_GE(least_eigenvalue(inflated - P), -1e-9 * P.norm());
}

/// A vehicle and landmarks born of it, in a belief that drops the map's correlations and in one that keeps
/// them.
struct Twins {
  Belief kept{64}, dropped{64, MapCorrelations::block_diagonal};
  std::vector<BlockId> landmarks;
  explicit Twins(RandomStream& random, int count) {
    const Eigen::MatrixXd P = random_covariance(random, 3);
    for (Belief* b : {&kept, &dropped}) b->add_vehicle(Chart::line(3), Eigen::Vector3d::Zero(), P);
    for (int i = 0; i < count; ++i) {
      const Belief::Parent parent{0, random_matrix(random, 2, 3)};
      const Eigen::MatrixXd noise = random_covariance(random, 2);
      for (Belief* b : {&kept, &dropped})
        landmarks.push_back(b->augment(Chart::line(2), Eigen::Vector2d::Zero(), {&parent, 1}, noise));
      landmarks.pop_back();
    }
  }
};

TEST(DroppedCorrelations, NeverSayMoreThanTheWholeFilterWould) {
  RandomStream random(6, "dropped");
  for (int run = 0; run < 20; ++run) {
    Twins twins(random, 1 + random.below(6));
    for (int step = 0; step < 30; ++step) {
      // From the same covariance, one update of either kind: what is kept must not be less
      const LinearizedMeasurement measurement =
          random_measurement(random, twins.dropped, 1 + random.below(2),
                             {0, twins.landmarks[static_cast<std::size_t>(
                                     random.below(static_cast<int>(twins.landmarks.size())))]});
      const Eigen::MatrixXd before = twins.dropped.dense_covariance();
      const Stacked stacked(twins.dropped, {&measurement, 1});
      const Posterior whole = textbook_update(before, stacked);
      ASSERT_EQ(twins.dropped.update({&measurement, 1}).outcome, UpdateReport::Outcome::updated);
      const Eigen::MatrixXd after = twins.dropped.dense_covariance();
      EXPECT_GE(least_eigenvalue(after - whole.P), -1e-9 * before.norm());
      EXPECT_TRUE(close(after.topRows(3), whole.P.topRows(3), 1e-9 * before.norm()));
      EXPECT_LE(after.trace(), before.trace() * (1 + 1e-12));
      EXPECT_TRUE(positive_definite(after));
      for (std::size_t i = 0; i < twins.landmarks.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
          EXPECT_TRUE(twins.dropped.covariance(twins.landmarks[i], twins.landmarks[j]).isZero(0));
    }
  }
}

TEST(DroppedCorrelations, BirthGrowsNoLessThanItsCorrelationsWere) {
  RandomStream random(7, "born apart");
  for (int run = 0; run < 20; ++run) {
    const Twins twins(random, 1 + random.below(6));
    const Eigen::MatrixXd grown = twins.dropped.dense_covariance() - twins.kept.dense_covariance();
    EXPECT_GE(least_eigenvalue(grown), -1e-9 * twins.kept.dense_covariance().norm());
  }
}

TEST(DroppedCorrelations, OneLandmarkLosesNothing) {
  RandomStream random(8, "alone");
  Twins twins(random, 1);
  for (int step = 0; step < 20; ++step) {
    const LinearizedMeasurement measurement =
        random_measurement(random, twins.kept, 2, {0, twins.landmarks[0]});
    twins.kept.update({&measurement, 1});
    twins.dropped.update({&measurement, 1});
    EXPECT_TRUE(close(twins.dropped.dense_covariance(), twins.kept.dense_covariance(), 1e-9));
    EXPECT_TRUE(close(twins.dropped.mean(0), twins.kept.mean(0), 1e-9));
  }
}

/// With one landmark nothing is dropped: two looks one after the other are two looks at once.
TEST(DroppedCorrelations, LooksOneAfterTheOtherAreLooksTogether) {
  RandomStream random(10, "in turn");
  for (int run = 0; run < 20; ++run) {
    Twins twins(random, 1);
    const std::vector<LinearizedMeasurement> measurements{
        random_measurement(random, twins.kept, 2, {0, twins.landmarks[0]}),
        random_measurement(random, twins.kept, 1, {0}),
        random_measurement(random, twins.kept, 2, {0, twins.landmarks[0]})};
    const UpdateReport a = twins.kept.update(measurements), b = twins.dropped.update(measurements);
    EXPECT_NEAR(a.nis, b.nis, 1e-9 * a.nis);
    EXPECT_TRUE(close(twins.dropped.dense_covariance(), twins.kept.dense_covariance(), 1e-9));
    EXPECT_TRUE(close(twins.dropped.mean(0), twins.kept.mean(0), 1e-9));
    EXPECT_TRUE(close(twins.dropped.mean(1), twins.kept.mean(1), 1e-9));
  }
}

TEST(DroppedCorrelations, RefuseToLoseAVariance) {
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

TEST(DroppedCorrelations, RefuseWhatWouldFillTheMap) {
  RandomStream random(11, "refused");
  Twins twins(random, 2);
  const LinearizedMeasurement measurement =
      random_measurement(random, twins.dropped, 1, {0, twins.landmarks[0]});
  std::vector<BlockVector> out(1);
  const BlockId ids[] = {0};
  EXPECT_THROW(twins.dropped.update_joseph({&measurement, 1}), std::logic_error);
  EXPECT_THROW(twins.dropped.correction({&measurement, 1}, ids, out), std::logic_error);
  EXPECT_THROW(twins.dropped.change_frame(
                   {0, Eigen::Vector3d::Zero(), Eigen::Matrix3d::Identity(), Eigen::Matrix3d::Zero()}, {}),
               std::logic_error);
  Belief two(8, MapCorrelations::block_diagonal);
  two.add_vehicle(Chart::line(1), Eigen::VectorXd::Zero(1), Eigen::MatrixXd::Identity(1, 1));
  EXPECT_THROW(two.add_vehicle(Chart::line(1), Eigen::VectorXd::Zero(1), Eigen::MatrixXd::Identity(1, 1)),
               std::logic_error);
}

TEST(DroppedCorrelations, TheGainIsThatOfItsCovariance) {
  RandomStream random(9, "gain");
  Twins twins(random, 4);
  const LinearizedMeasurement measurement =
      random_measurement(random, twins.dropped, 2, {0, twins.landmarks[2]});
  const std::vector<BlockId> ids{0, twins.landmarks[0], twins.landmarks[1], twins.landmarks[2],
                                 twins.landmarks[3]};
  const Eigen::VectorXd before = stacked_mean(twins.dropped, ids);
  const Posterior whole =
      textbook_update(twins.dropped.dense_covariance(), Stacked(twins.dropped, {&measurement, 1}));
  twins.dropped.update({&measurement, 1});
  EXPECT_TRUE(close(stacked_mean(twins.dropped, ids) - before, whole.delta, 1e-9));
}

}  // namespace
}  // namespace incognita::testing
