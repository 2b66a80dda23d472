// What a belief notes of what is done to it.
#include "tests/belief/dense.hpp"

namespace incognita::testing {
namespace {

AffineLook look_at(BlockId id, double variance) {
  AffineLook look;
  look.add(id, Eigen::MatrixXd::Identity(1, 2));
  look.residual = Eigen::VectorXd::Zero(1);
  look.R = variance * Eigen::MatrixXd::Identity(1, 1);
  return look;
}

TEST(Trace, HasEverythingThatWasDoneInOrder) {
  const Eigen::Matrix2d I = Eigen::Matrix2d::Identity();
  const Eigen::Vector2d zero = Eigen::Vector2d::Zero();
  Belief belief;
  const BlockId vehicle = belief.add_vehicle(Chart::line(2), zero, I);
  belief.predict({vehicle, zero, I, I});
  EXPECT_TRUE(belief.trace().empty());  // nobody had asked
  belief.keep_trace(true);
  belief.predict({vehicle, zero, 2 * I, I});
  const Belief::Parent parent{vehicle, 3 * I};
  const BlockId landmark = belief.augment(Chart::line(2), zero, {&parent, 1}, I);
  const std::vector<AffineLook> looks{look_at(vehicle, 1), look_at(landmark, 2)};
  belief.update(looks);
  belief.update_joseph({looks.data(), 1});
  belief.replace(landmark, Chart::line(1), Eigen::VectorXd::Zero(1), I.topRows(1),
                 Eigen::MatrixXd::Zero(1, 1));
  belief.decorrelate(Belief::Scope::everything);
  belief.carry({vehicle, zero, I, I}, {});
  belief.drop(landmark);
  const BeliefTrace& trace = belief.trace();
  ASSERT_EQ(trace.size(), 9u);
  EXPECT_EQ(std::get<AffineMotion>(trace[0]).A, 2 * I);
  EXPECT_EQ(std::get<BlockBirth>(trace[1]).parents[0].J, 3 * I);
  EXPECT_EQ(std::get<BlockBirth>(trace[1]).block, landmark);
  EXPECT_EQ(std::get<AffineLook>(trace[2]).parts[0].block, vehicle);
  EXPECT_EQ(std::get<AffineLook>(trace[3]).R(0, 0), 2);
  EXPECT_EQ(std::get<AffineLook>(trace[4]).parts[0].block, vehicle);
  EXPECT_EQ(std::get<BlockReplacement>(trace[5]).J, I.topRows(1));
  EXPECT_EQ(std::get<Reshaping>(trace[6]), Reshaping::decorrelated);
  EXPECT_EQ(std::get<Reshaping>(trace[7]), Reshaping::carried);
  EXPECT_EQ(std::get<BlockDrop>(trace[8]).block, landmark);
  belief.clear_trace();
  EXPECT_TRUE(belief.trace().empty());
  EXPECT_TRUE(belief.keeps_trace());
}

TEST(Trace, LeavesOutWhatWasRefused) {
  Belief belief;
  const BlockId vehicle =
      belief.add_vehicle(Chart::line(2), Eigen::Vector2d::Zero(), 1e20 * Eigen::Matrix2d::Identity());
  belief.keep_trace(true);
  const AffineLook look = look_at(vehicle, 1e-3);
  EXPECT_EQ(belief.update({&look, 1}).outcome, UpdateReport::Outcome::singular);
  EXPECT_TRUE(belief.trace().empty());
}

TEST(Trace, BelongsToItsBelief) {
  Belief belief;
  const BlockId vehicle =
      belief.add_vehicle(Chart::line(2), Eigen::Vector2d::Zero(), Eigen::Matrix2d::Identity());
  belief.keep_trace(true);
  Belief imagined = belief;
  const AffineLook look = look_at(vehicle, 1);
  imagined.update({&look, 1});
  EXPECT_TRUE(belief.trace().empty());
  EXPECT_EQ(imagined.trace().size(), 1u);
}

}  // namespace
}  // namespace incognita::testing
