// Invalid operations are refused, with the sizes, and leave the belief unchanged.
#include <functional>
#include <limits>
#include <string>

#include "tests/belief/dense.hpp"

namespace incognita::testing {
namespace {

class Refusal : public ::testing::Test {
 protected:
  RandomStream random{1, "refusal"};
  Map map{random, {6}, {3, 3, 6}};
  std::vector<BlockId> ids{0, 1, 2, 3};

  LinearizedMeasurement measurement(BlockId landmark) {
    return random_measurement(random, map.belief, 2, {map.vehicles[0], landmark});
  }

  void refuses(const std::vector<LinearizedMeasurement>& measurements) {
    const Photograph before(map.belief, ids);
    EXPECT_EQ(map.belief.update(measurements).outcome, UpdateReport::Outcome::singular);
    EXPECT_EQ(map.belief.update_joseph(measurements).outcome, UpdateReport::Outcome::singular);
    EXPECT_TRUE(Photograph(map.belief, ids) == before);
  }

  /// The message must contain what was given and what would be valid.
  void throws(const std::string& given, const std::string& fits, const std::function<void()>& call) {
    const Photograph before(map.belief, ids);
    const int errors = map.belief.errors(), blocks = map.belief.block_count();
    try {
      call();
      ADD_FAILURE() << "not refused: " << given;
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find(given), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find(fits), std::string::npos) << error.what();
    }
    EXPECT_TRUE(Photograph(map.belief, ids) == before);
    EXPECT_EQ(map.belief.errors(), errors);
    EXPECT_EQ(map.belief.block_count(), blocks);
  }
};

TEST_F(Refusal, OfTheSameExactMeasurementTwice) {
  LinearizedMeasurement perfect = measurement(1);
  perfect.R = 1e-20 * MeasurementMatrix::Identity(2, 2);
  refuses({perfect, perfect});
}

TEST_F(Refusal, OfMeasurementsThatDifferOnlyByRounding) {
  for (int run = 0; run < 50; ++run) {  // S is singular, but its last pivot may be positive after rounding
    LinearizedMeasurement a = measurement(1), b = a;
    a.R = b.R = 1e-20 * MeasurementMatrix::Identity(2, 2);
    for (int i = 0; i < 2; ++i) b.parts[i].H *= 1.0 / 3.0;
    refuses({a, b});
  }
}

TEST_F(Refusal, OfNoiseThatIsNotPositiveDefinite) {
  LinearizedMeasurement negative = measurement(1), zero = measurement(2), undefined = measurement(3);
  negative.R(1, 1) = -1;
  zero.R.setZero();
  undefined.R(0, 0) = std::numeric_limits<double>::quiet_NaN();
  refuses({negative});
  refuses({measurement(1), zero});
  refuses({undefined});
}

TEST_F(Refusal, OfNonFiniteNumbers) {
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    LinearizedMeasurement residual = measurement(1), jacobian = measurement(2);
    residual.residual[1] = bad;
    jacobian.parts[0].H(0, 2) = bad;
    refuses({residual});
    refuses({jacobian, measurement(1)});
  }
}

TEST_F(Refusal, OfAnUpdateThatLosesAVarianceToRounding) {
  Belief vague;
  const BlockId robot =
      vague.add_vehicle(Chart::line(1), Eigen::VectorXd::Zero(1), Eigen::MatrixXd::Constant(1, 1, 1e17));
  LinearizedMeasurement fix;
  fix.add(robot, Eigen::MatrixXd::Identity(1, 1));
  fix.residual = MeasurementVector::Constant(1, 5);
  fix.R = MeasurementMatrix::Identity(1, 1);
  EXPECT_EQ(vague.update({&fix, 1}).outcome, UpdateReport::Outcome::singular);
  EXPECT_EQ(vague.covariance(robot)(0, 0), 1e17);
  EXPECT_EQ(vague.mean(robot)[0], 0);
  EXPECT_EQ(vague.update_joseph({&fix, 1}).outcome, UpdateReport::Outcome::updated);
  EXPECT_NEAR(vague.covariance(robot)(0, 0), 1, 1e-9);
  EXPECT_NEAR(vague.mean(robot)[0], 5, 1e-9);
}

TEST_F(Refusal, OfMeasurementsOfWrongSize) {
  LinearizedMeasurement wide = measurement(1), tall = measurement(1), noise = measurement(1),
                        gone = measurement(1);
  wide.parts[1].H.setZero(2, 4);
  tall.parts[0].H.setZero(3, 6);
  noise.R.setIdentity(3, 3);
  gone.parts[1].block = 99;
  for (const auto& update : {&Belief::update, &Belief::update_joseph}) {
    const auto call = [&](const LinearizedMeasurement& bad) {
      const std::vector<LinearizedMeasurement> measurements = {measurement(2), bad};
      (map.belief.*update)(measurements);
    };
    throws("2x4", "2x3", [&] { call(wide); });
    throws("3x6", "2x6", [&] { call(tall); });
    throws("3x3", "2 numbers", [&] { call(noise); });
    throws("99", "no block", [&] { call(gone); });
  }
  Eigen::MatrixXd S;
  throws("2x4", "2x3", [&] { map.belief.innovation_covariance({&wide, 1}, S); });
}

TEST_F(Refusal, OfAMeasurementOfTooManyBlocks) {
  LinearizedMeasurement many = random_measurement(random, map.belief, 1, {0, 1, 2});
  EXPECT_THROW(many.add(3, Eigen::MatrixXd::Zero(1, 6)), std::length_error);
  EXPECT_EQ(many.part_count, 3);
}

TEST_F(Refusal, OfAMotionOfWrongSize) {
  const LinearizedMotion good{0, BlockVector::Zero(6), BlockMatrix::Identity(6, 6), BlockMatrix::Zero(6, 6)};
  LinearizedMotion mean = good, A = good, N = good, gone = good;
  mean.x_next.setZero(7);
  A.A.setIdentity(6, 5);
  N.N.setIdentity(3, 3);
  gone.block = 42;
  throws("7 numbers", "6", [&] { map.belief.predict(mean); });
  throws("6x5", "6 errors", [&] { map.belief.predict(A); });
  throws("3x3", "6 errors", [&] { map.belief.predict(N); });
  throws("42", "no block", [&] { map.belief.predict(gone); });
}

TEST_F(Refusal, OfBlocksOfWrongSize) {
  Belief& belief = map.belief;
  const Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  const Eigen::Matrix3d noise = Eigen::Matrix3d::Identity();
  const std::vector<Belief::Parent> wrong = {{0, BlockMatrix::Zero(3, 5)}},
                                    gone = {{77, BlockMatrix::Zero(3, 5)}};
  throws("3 numbers", "2", [&] { belief.augment(Chart::line(2), mean, {}, noise); });
  throws("3x3", "2 errors", [&] { belief.augment(Chart::line(2), mean.head(2), {}, noise); });
  throws("3x5", "3x6", [&] { belief.augment(Chart::line(3), mean, wrong, noise); });
  throws("77", "no block", [&] { belief.augment(Chart::line(3), mean, gone, noise); });
  throws("17", "16", [&] {
    belief.augment(Chart::line(17), Eigen::VectorXd::Zero(17), {}, Eigen::MatrixXd::Identity(17, 17));
  });
  throws("3", "6", [&] {
    belief.replace(1, Chart::line(6), Eigen::VectorXd::Zero(6), BlockMatrix::Zero(6, 3),
                   BlockMatrix::Zero(6, 6));
  });
  throws("3x3", "6 errors by 3", [&] { belief.replace(3, Chart::line(3), mean, noise, noise); });
  throws("3 numbers", "2", [&] { belief.replace(3, Chart::line(2), mean, BlockMatrix::Zero(2, 6), noise); });
  throws("2 numbers", "3", [&] { belief.set_mean(1, mean.head(2)); });
  throws("88", "no block", [&] { belief.drop(88); });
  EXPECT_THROW(belief.add_vehicle(Chart::line(3), mean, noise), std::logic_error);
  Belief empty;
  EXPECT_THROW(empty.add_vehicle(Chart::line(3), mean, noise.topRows(2)), std::invalid_argument);
  EXPECT_THROW(empty.add_vehicle(Chart::line(2), mean, noise.topLeftCorner(2, 2)), std::invalid_argument);
  EXPECT_EQ(empty.errors(), 0);
}

}  // namespace
}  // namespace incognita::testing
