// The trace of the operations on a belief.
#include "incognita/belief/any_belief.hpp"
#include "tests/belief/dense.hpp"

namespace incognita::testing {
namespace {

LinearizedMeasurement look_at(BlockId id, double variance) {
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
  const std::vector<LinearizedMeasurement> measurements{look_at(vehicle, 1), look_at(landmark, 2)};
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
  const LinearizedMeasurement measurement = look_at(vehicle, 1e-3);
  EXPECT_EQ(belief.update({&measurement, 1}).outcome, UpdateReport::Outcome::singular);
  EXPECT_TRUE(belief.trace().empty());
}

TEST(Trace, IsNotCopiedWithTheBelief) {
  Belief belief;
  const BlockId vehicle =
      belief.add_vehicle(Chart::line(2), Eigen::Vector2d::Zero(), Eigen::Matrix2d::Identity());
  belief.keep_trace(true);
  Belief imagined = belief;
  const LinearizedMeasurement measurement = look_at(vehicle, 1);
  imagined.update({&measurement, 1});
  EXPECT_TRUE(belief.trace().empty());
  EXPECT_EQ(imagined.trace().size(), 1u);
}

TEST(AnyBelief, TakesNoiseOfABlockBack) {
  const Eigen::Matrix2d I = Eigen::Matrix2d::Identity();
  for (AnyBelief belief : {AnyBelief(Belief()), AnyBelief(InformationBelief())}) {
    const BlockId vehicle = belief.add_vehicle(Chart::line(2), Eigen::Vector2d(1, 2), I);
    const BlockId other = belief.add_vehicle(Chart::line(2), Eigen::Vector2d(3, 4), 2 * I);
    const BlockParent parent{other, 0.3 * I};
    const BlockId landmark = belief.augment(Chart::line(2), Eigen::Vector2d(5, 6), {&parent, 1}, 0.1 * I);
    std::vector<LinearizedMeasurement> measurements{look_at(vehicle, 1), look_at(landmark, 2)};
    measurements[0].add(other, Eigen::MatrixXd::Constant(1, 2, 0.7));
    belief.update(measurements);
    belief.keep_trace(true);
    belief.predict({vehicle, belief.mean(vehicle), I, 0.01 * I});
    const Eigen::MatrixXd P = belief.dense_covariance();
    const Eigen::VectorXd mean = belief.mean(other);
    AnyBelief::BeforeNoise before = belief.before_noise(other);
    belief.predict({other, mean + Eigen::Vector2d(1, -1), I, 5 * I});
    EXPECT_GT(belief.covariance(other)(0, 0), P(2, 2) + 4);
    belief.take_noise_back(std::move(before));
    EXPECT_EQ(belief.dense_covariance(), P);
    EXPECT_EQ(Eigen::VectorXd(belief.mean(other)), mean);
    EXPECT_EQ(belief.trace().size(), 1u);
  }
}

}  // namespace
}  // namespace incognita::testing
