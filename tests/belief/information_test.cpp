// The information form against the covariance form under the same operations.
#include "incognita/belief/information_belief.hpp"

#include "incognita/belief/any_belief.hpp"
#include "incognita/belief/iterated_update.hpp"
#include "tests/belief/dense.hpp"

namespace incognita::testing {
namespace {

const Chart pose_in_space{{Chart::Kind::line, 3}, {Chart::Kind::quaternion, 4}};

Eigen::VectorXd mean_on(RandomStream& random, const Chart& chart) {
  Eigen::VectorXd mean = random_matrix(random, chart.ambient(), 1);
  if (chart.ambient() > chart.tangent()) mean.segment<4>(3).normalize();
  return mean;
}

/// Both forms, with the same operations applied.
struct Pair {
  Belief covariance;
  InformationBelief information;
  std::vector<BlockId> ids;

  void add_vehicle(RandomStream& random, const Chart& chart) {
    const Eigen::VectorXd mean = mean_on(random, chart);
    const Eigen::MatrixXd P = random_covariance(random, chart.tangent());
    ids.push_back(covariance.add_vehicle(chart, mean, P));
    ASSERT_EQ(information.add_vehicle(chart, mean, P), ids.back());
  }
  void augment(RandomStream& random, const Chart& chart) {
    std::vector<BlockParent> parents;
    for (const BlockId id : {ids.front(), ids.back()})  // the same block while there is only one
      parents.push_back({id, random_matrix(random, chart.tangent(), covariance.chart(id).tangent())});
    const Eigen::VectorXd mean = mean_on(random, chart);
    const Eigen::MatrixXd noise = random_covariance(random, chart.tangent());
    ids.push_back(covariance.augment(chart, mean, parents, noise));
    ASSERT_EQ(information.augment(chart, mean, parents, noise), ids.back());
  }
  LinearizedMotion motion(RandomStream& random, BlockId id) const {
    const int size = covariance.chart(id).tangent();
    const Eigen::MatrixXd G = 0.3 * random_matrix(random, size, std::max(1, size - 1));  // N is singular
    return {id, mean_on(random, covariance.chart(id)),
            BlockMatrix::Identity(size, size) + 0.2 * random_matrix(random, size, size), G * G.transpose()};
  }
  std::vector<LinearizedMeasurement> measurements(RandomStream& random) const {
    std::vector<LinearizedMeasurement> all;
    for (int i = 1 + random.below(6); i > 0; --i) {
      std::vector<BlockId> blocks;
      for (int k = 1 + random.below(3); k > 0; --k)
        blocks.push_back(ids[static_cast<std::size_t>(random.below(static_cast<int>(ids.size())))]);
      all.push_back(random_measurement(random, covariance, 1 + random.below(4), blocks));
    }
    return all;
  }
  ::testing::AssertionResult same(double tolerance) const {
    const Eigen::MatrixXd P = covariance.dense_covariance();
    for (const BlockId id : ids)
      if (auto close_mean = close(information.mean(id), covariance.mean(id), tolerance); !close_mean)
        return close_mean << " in the mean of " << id;
    return close_covariance(information.dense_covariance(), P, P, tolerance);
  }
};

TEST(InformationForm, AgreesWithTheCovarianceFormUnderAnyOperations) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    RandomStream random(seed, "information");
    Pair both;
    both.add_vehicle(random, Chart::line(3));
    both.add_vehicle(random, pose_in_space);
    for (int step = 0; step < 60; ++step) {
      const BlockId any = both.ids[static_cast<std::size_t>(random.below(static_cast<int>(both.ids.size())))];
      const int what = random.below(8);
      if (what == 0) {
        both.augment(random, Chart::line(1 + random.below(5)));
      } else if (what == 1 && any >= 2) {  // fewer errors, with or without noise
        const int size = both.covariance.chart(any).tangent(), left = 1 + random.below(size);
        const Eigen::VectorXd mean = random_matrix(random, left, 1);
        const BlockMatrix J = random_matrix(random, left, size);
        const BlockMatrix noise = random.below(2) * random_covariance(random, left);
        both.covariance.replace(any, Chart::line(left), mean, J, noise);
        both.information.replace(any, Chart::line(left), mean, J, noise);
      } else if (what == 2 && any >= 2) {
        both.covariance.drop(any);
        both.information.drop(any);
        std::erase(both.ids, any);
      } else if (what <= 4) {
        const LinearizedMotion motion = both.motion(random, any);
        both.covariance.predict(motion);
        both.information.predict(motion);
      } else {
        const std::vector<LinearizedMeasurement> measurements = both.measurements(random);
        Eigen::MatrixXd S, theirs;
        both.covariance.innovation_covariance(measurements, S);
        both.information.innovation_covariance(measurements, theirs);
        ASSERT_TRUE(close(theirs, S, 1e-9));
        std::vector<BlockVector> expected(both.ids.size()), corrections(both.ids.size());
        ASSERT_TRUE(both.covariance.correction(measurements, both.ids, expected));
        ASSERT_TRUE(both.information.correction(measurements, both.ids, corrections));
        for (std::size_t i = 0; i < expected.size(); ++i)
          EXPECT_LE((corrections[i] - expected[i]).norm(), 1e-8 * (1 + expected[i].norm()));
        ASSERT_TRUE(both.same(1e-8)) << "queries do not change the state";
        const UpdateReport a = both.covariance.update(measurements),
                           b = both.information.update(measurements);
        ASSERT_EQ(a.outcome, UpdateReport::Outcome::updated);
        ASSERT_EQ(b.outcome, UpdateReport::Outcome::updated);
        EXPECT_EQ(a.rows, b.rows);
        EXPECT_NEAR(a.nis, b.nis, 1e-8 * a.nis);
        EXPECT_NEAR(a.log_det_S, b.log_det_S, 1e-8);
        EXPECT_NEAR(a.log_det_R, b.log_det_R, 1e-10);
      }
      ASSERT_EQ(both.information.errors(), both.covariance.errors());
      ASSERT_TRUE(both.same(1e-8)) << "seed " << seed << " step " << step << " doing " << what;
    }
  }
}

TEST(InformationForm, IsTheInverseOfTheCovariance) {
  RandomStream random(3, "inverse");
  Pair both;
  both.add_vehicle(random, Chart::line(3));
  for (int i = 0; i < 12; ++i) both.augment(random, Chart::line(3));
  const Eigen::MatrixXd P = both.covariance.dense_covariance();
  const Eigen::VectorXd spread = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(P).eigenvalues();
  const double rounding = 1e-14 * spread.maxCoeff() / spread.minCoeff();
  ASSERT_LT(rounding, 1e-2) << "the comparison is meaningful";
  const Eigen::MatrixXd product = both.information.dense_information() * P;
  EXPECT_LT((product - Eigen::MatrixXd::Identity(P.rows(), P.cols())).cwiseAbs().maxCoeff(), rounding);
  // det P = det P_map * det P_vehicle|map, from the factor and from the covariance
  const auto dets = both.information.log_determinants(3);
  const Eigen::MatrixXd map = P.bottomRightCorner(P.rows() - 3, P.cols() - 3);
  EXPECT_NEAR(dets.all, std::log(P.determinant()), rounding);
  EXPECT_NEAR(dets.first, std::log(P.topLeftCorner(3, 3).determinant()), rounding);
  EXPECT_NEAR(dets.others, std::log(map.determinant()), rounding);
}

TEST(InformationForm, AcceptsASingularMotion) {
  RandomStream random(4, "stop");
  Pair both;
  both.add_vehicle(random, Chart::line(4));
  both.augment(random, Chart::line(2));
  // Two of the errors are forgotten and drawn again, the others kept exactly
  LinearizedMotion motion{both.ids[0], Eigen::VectorXd::Zero(4), BlockMatrix::Zero(4, 4),
                          BlockMatrix::Zero(4, 4)};
  motion.A.topLeftCorner(2, 2).setIdentity();
  motion.N.bottomRightCorner(2, 2) = 0.5 * Eigen::Matrix2d::Identity();
  both.covariance.predict(motion);
  both.information.predict(motion);
  EXPECT_TRUE(both.same(1e-10));
}

std::string why(const std::function<void()>& work) {
  try {
    work();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(InformationForm, RefusesExactKnowledge) {
  RandomStream random(5, "exactly");
  Pair both;
  both.add_vehicle(random, Chart::line(2));
  both.augment(random, Chart::line(2));
  InformationBelief& belief = both.information;
  const Eigen::Vector2d zero = Eigen::Vector2d::Zero();
  const BlockMatrix I = BlockMatrix::Identity(2, 2), O = BlockMatrix::Zero(2, 2);
  BlockMatrix half = O;
  half(0, 0) = 1;
  EXPECT_NE(why([&] { InformationBelief().add_vehicle(Chart::line(2), zero, half); }).find("infinite"),
            std::string::npos);
  EXPECT_NE(why([&] { belief.augment(Chart::line(2), zero, {}, half); }).find("infinite"), std::string::npos);
  EXPECT_NE(why([&] { belief.predict({both.ids[0], zero, half, O}); }).find("infinite"), std::string::npos);
  EXPECT_NE(why([&] { belief.replace(both.ids[1], Chart::line(2), zero, half, O); }).find("infinite"),
            std::string::npos);
  EXPECT_NE(why([&] {
              belief.predict({both.ids[0], zero, I, BlockMatrix::Zero(1, 1)});
            }).find("1x1"),
            std::string::npos);
  EXPECT_TRUE(both.same(1e-12));
}

TEST(InformationForm, RefusesInvalidMeasurements) {
  RandomStream random(6, "looks");
  Pair both;
  both.add_vehicle(random, Chart::line(3));
  both.augment(random, Chart::line(2));
  const Photograph before(both.covariance, both.ids);
  const Eigen::MatrixXd information = both.information.dense_information();
  EXPECT_EQ(both.information.update({}).outcome, UpdateReport::Outcome::nothing);
  LinearizedMeasurement bad = random_measurement(random, both.covariance, 2, {both.ids[0]});
  bad.R(0, 0) = bad.R(0, 1) = bad.R(1, 0) = 0;
  EXPECT_EQ(both.information.update({&bad, 1}).outcome, UpdateReport::Outcome::singular);
  bad = random_measurement(random, both.covariance, 2, {both.ids[0]});
  bad.residual[0] = std::nan("");
  EXPECT_EQ(both.information.update({&bad, 1}).outcome, UpdateReport::Outcome::singular);
  bad.residual[0] = 0;
  bad.parts[0].H *= 1e200;  // all other information would be lost to rounding
  EXPECT_EQ(both.information.update({&bad, 1}).outcome, UpdateReport::Outcome::singular);
  EXPECT_EQ(both.information.dense_information(), information);
  EXPECT_TRUE(both.same(1e-12));
}

TEST(InformationForm, ReportsANonFiniteInformationMatrix) {
  RandomStream random(7, "nothing");
  Pair both;
  both.add_vehicle(random, Chart::line(2));
  both.augment(random, Chart::line(2));
  const BlockMatrix I = BlockMatrix::Identity(2, 2);
  both.information.predict({both.ids[0], Eigen::Vector2d::Zero(), I, std::nan("") * I});
  EXPECT_TRUE(both.information.covariance(both.ids[1]).hasNaN());
  EXPECT_TRUE(std::isnan(both.information.log_determinants(2).all));
  const LinearizedMeasurement measurement = random_measurement(random, both.covariance, 2, {both.ids[0]});
  EXPECT_EQ(both.information.update({&measurement, 1}).outcome, UpdateReport::Outcome::singular);
}

TEST(InformationForm, RecordsTheSameTraceAsTheCovarianceForm) {
  RandomStream random(8, "trace");
  AnyBelief forms[] = {AnyBelief(Belief()), AnyBelief(InformationBelief())};
  for (AnyBelief& belief : forms) {
    RandomStream same(9, "trace");
    belief.keep_trace(true);
    const BlockId vehicle =
        belief.add_vehicle(Chart::line(2), Eigen::Vector2d::Zero(), random_covariance(same, 2));
    const BlockParent parent{vehicle, random_matrix(same, 2, 2)};
    const BlockId landmark =
        belief.augment(Chart::line(2), Eigen::Vector2d::Zero(), {&parent, 1}, random_covariance(same, 2));
    const BlockMatrix I = BlockMatrix::Identity(2, 2);
    belief.predict({vehicle, Eigen::Vector2d::Zero(), I, I});
    LinearizedMeasurement measurement;
    measurement.add(vehicle, I);
    measurement.add(landmark, I);
    measurement.residual = Eigen::Vector2d::Ones();
    measurement.R = I;
    belief.update({&measurement, 1});
    belief.replace(landmark, Chart::line(1), Eigen::VectorXd::Zero(1), I.topRows(1), BlockMatrix::Zero(1, 1));
    belief.drop(landmark);
  }
  ASSERT_EQ(forms[0].trace().size(), 5u);
  ASSERT_EQ(forms[1].trace().size(), 5u);
  for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(forms[0].trace()[i].index(), forms[1].trace()[i].index());
}

TEST(InformationForm, IteratedUpdateAgrees) {
  RandomStream random(10, "iterated");
  Pair both;
  both.add_vehicle(random, Chart::line(2));
  both.augment(random, Chart::line(2));
  const auto range = [&](const auto& belief) {
    const Eigen::Vector2d apart = belief.mean(both.ids[1]) - belief.mean(both.ids[0]);
    LinearizedMeasurement measurement;
    const Eigen::RowVector2d direction = apart.transpose() / apart.norm();
    measurement.add(both.ids[0], -direction);
    measurement.add(both.ids[1], direction);
    measurement.residual = Eigen::VectorXd::Constant(1, 4 - apart.norm());
    measurement.R = 0.05 * Eigen::MatrixXd::Identity(1, 1);
    return std::vector<LinearizedMeasurement>{measurement};
  };
  const IterationSettings until{.max_iterations = 100};
  const IterationReport a = update_iterated(both.covariance, both.ids, range, until),
                        b = update_iterated(both.information, both.ids, range, until);
  EXPECT_TRUE(a.converged);
  EXPECT_TRUE(b.converged);
  EXPECT_GT(a.iterations, 1);
  EXPECT_EQ(a.iterations, b.iterations);
  EXPECT_TRUE(both.same(1e-9));
}

}  // namespace
}  // namespace incognita::testing
