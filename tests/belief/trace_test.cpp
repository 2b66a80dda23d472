// The trace of the operations on a belief.
#include "incognita/belief/any_belief.hpp"
#include "tests/belief/dense.hpp"

namespace incognita::testing {
namespace {

LinearizedMeasurement measurement_of(BlockId id, double variance) {
  LinearizedMeasurement measurement;
  measurement.add(id, Eigen::MatrixXd::Identity(1, 2));
  measurement.residual = Eigen::VectorXd::Zero(1);
  measurement.R = variance * Eigen::MatrixXd::Identity(1, 1);
  return measurement;
}

TEST(Trace, HasEveryOperationInOrder) {
  const Eigen::Matrix2d I = Eigen::Matrix2d::Identity();
  const Eigen::Vector2d zero = Eigen::Vector2d::Zero();
  Belief belief;
  const BlockId vehicle = belief.add_vehicle(Chart::line(2), zero, I);
  belief.predict({vehicle, zero, I, I});
  EXPECT_TRUE(belief.trace().empty());  // the trace is off by default
  belief.keep_trace(true);
  belief.predict({vehicle, zero, 2 * I, I});
  const Belief::Parent parent{vehicle, 3 * I};
  const BlockId landmark = belief.augment(Chart::line(2), zero, {&parent, 1}, I);
  const std::vector<LinearizedMeasurement> measurements{measurement_of(vehicle, 1),
                                                        measurement_of(landmark, 2)};
  belief.update(measurements);
  belief.update_joseph({measurements.data(), 1});
  belief.replace(landmark, Chart::line(1), Eigen::VectorXd::Zero(1), I.topRows(1),
                 Eigen::MatrixXd::Zero(1, 1));
  belief.decorrelate(Belief::Scope::everything);
  belief.change_frame({vehicle, zero, I, I}, {});
  belief.drop(landmark);
  const BeliefTrace& trace = belief.trace();
  ASSERT_EQ(trace.size(), 9u);
  EXPECT_EQ(std::get<LinearizedMotion>(trace[0]).A, 2 * I);
  EXPECT_EQ(std::get<BlockAugmentation>(trace[1]).parents[0].J, 3 * I);
  EXPECT_EQ(std::get<BlockAugmentation>(trace[1]).block, landmark);
  EXPECT_EQ(std::get<LinearizedMeasurement>(trace[2]).parts[0].block, vehicle);
  EXPECT_EQ(std::get<LinearizedMeasurement>(trace[3]).R(0, 0), 2);
  EXPECT_EQ(std::get<LinearizedMeasurement>(trace[4]).parts[0].block, vehicle);
  EXPECT_EQ(std::get<BlockReplacement>(trace[5]).J, I.topRows(1));
  EXPECT_EQ(std::get<CovarianceEdit>(trace[6]), CovarianceEdit::decorrelated);
  EXPECT_EQ(std::get<CovarianceEdit>(trace[7]), CovarianceEdit::frame_changed);
  EXPECT_EQ(std::get<BlockDrop>(trace[8]).block, landmark);
  belief.clear_trace();
  EXPECT_TRUE(belief.trace().empty());
  EXPECT_TRUE(belief.keeps_trace());
}

TEST(Trace, OmitsRefusedOperations) {
  Belief belief;
  const BlockId vehicle =
      belief.add_vehicle(Chart::line(2), Eigen::Vector2d::Zero(), 1e20 * Eigen::Matrix2d::Identity());
  belief.keep_trace(true);
  const LinearizedMeasurement measurement = measurement_of(vehicle, 1e-3);
  EXPECT_EQ(belief.update({&measurement, 1}).outcome, UpdateReport::Outcome::singular);
  EXPECT_TRUE(belief.trace().empty());
}

TEST(Trace, IsNotCopiedWithTheBelief) {
  Belief belief;
  const BlockId vehicle =
      belief.add_vehicle(Chart::line(2), Eigen::Vector2d::Zero(), Eigen::Matrix2d::Identity());
  belief.keep_trace(true);
  Belief imagined = belief;
  const LinearizedMeasurement measurement = measurement_of(vehicle, 1);
  imagined.update({&measurement, 1});
  EXPECT_TRUE(belief.trace().empty());
  EXPECT_EQ(imagined.trace().size(), 1u);
}

/// A vehicle with a quaternion and `landmarks` of two errors each, all correlated as the form allows.
BlockId add_vehicle_and_landmarks(AnyBelief& belief, int landmarks) {
  const Chart chart{{Chart::Kind::line, 3}, {Chart::Kind::quaternion, 4}};
  Eigen::Matrix<double, 7, 1> mean;
  mean << 1, 2, 3, 0.5, 0.5, 0.5, 0.5;
  Eigen::MatrixXd J = Eigen::MatrixXd::Constant(2, 6, 0.2);
  const BlockId vehicle = belief.add_vehicle(chart, mean, 0.3 * Eigen::MatrixXd::Identity(6, 6));
  const BlockParent parent{vehicle, J};
  for (int i = 0; i < landmarks; ++i) {
    const BlockId landmark = belief.augment(Chart::line(2), Eigen::Vector2d(i, -i), {&parent, 1},
                                            0.1 * Eigen::Matrix2d::Identity());
    LinearizedMeasurement measurement = measurement_of(landmark, 0.5 + i);
    measurement.add(vehicle, Eigen::MatrixXd::Constant(1, 6, 0.7));
    belief.update({&measurement, 1});
  }
  return vehicle;
}

TEST(AnyBelief, TakesNoiseOfABlockBack) {
  for (AnyBelief belief : {AnyBelief(Belief()), AnyBelief(Belief(64, MapCorrelations::block_diagonal)),
                           AnyBelief(InformationBelief())}) {
    const BlockId vehicle = add_vehicle_and_landmarks(belief, 40);  // more rows than predict() takes at once
    belief.keep_trace(true);
    const Eigen::MatrixXd I = Eigen::MatrixXd::Identity(6, 6);
    belief.predict({vehicle, belief.mean(vehicle), I, 0.01 * I});
    const Eigen::MatrixXd P = belief.dense_covariance();
    const Eigen::VectorXd mean = belief.mean(vehicle);
    AnyBelief::BeforeNoise before = belief.before_noise(vehicle);
    Eigen::VectorXd moved = mean;
    moved.tail<4>() << 1, 0, 0, 0;
    belief.predict({vehicle, moved, I, 5 * I});
    belief.predict({vehicle, moved, I, I});
    EXPECT_GT(belief.covariance(vehicle)(0, 0), P(0, 0) + 5);
    belief.take_noise_back(std::move(before));
    EXPECT_EQ(belief.dense_covariance(), P);
    EXPECT_EQ(Eigen::VectorXd(belief.mean(vehicle)), mean);
    EXPECT_EQ(belief.trace().size(), 1u);
  }
}

TEST(Belief, RestoresNoBlockOfAnotherSize) {
  Belief belief;
  const BlockId vehicle =
      belief.add_vehicle(Chart::line(2), Eigen::Vector2d::Zero(), Eigen::Matrix2d::Identity());
  EXPECT_THROW(belief.restore(vehicle, Eigen::Vector2d(1, 1), Eigen::Matrix3d::Identity(), 0),
               std::invalid_argument);
  EXPECT_THROW(belief.restore(vehicle, Eigen::Vector3d(1, 1, 1), Eigen::Matrix2d::Zero(), 0),
               std::invalid_argument);
  EXPECT_EQ(belief.dense_covariance(), Eigen::Matrix2d::Identity());
  EXPECT_EQ(Eigen::VectorXd(belief.mean(vehicle)), Eigen::Vector2d::Zero());
}

}  // namespace
}  // namespace incognita::testing
