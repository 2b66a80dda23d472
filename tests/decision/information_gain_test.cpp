// Information gain of predicted measurements, computed in measurement space, against the thesis' determinants
// of the whole covariance, (6.6), step by step with textbook posteriors.
#include "incognita/decision/information_gain.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include <Eigen/LU>
#include <vector>

#include "incognita/math/gaussian.hpp"
#include "incognita/math/random.hpp"

namespace incognita {
namespace {

constexpr double unseen_var = 1.5;
constexpr int unseen_count = 2;

Eigen::MatrixXd random_matrix(RandomStream& random, int rows, int columns) {
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return random.normal(); });
}

Eigen::MatrixXd random_covariance(RandomStream& random, int size) {
  const Eigen::MatrixXd a = random_matrix(random, size, size + 3);
  return a * a.transpose() / size + 0.01 * Eigen::MatrixXd::Identity(size, size);
}

struct SmallMap {
  AnyBelief belief;
  BlockId vehicle = 0;
  std::vector<BlockId> landmarks;

  SmallMap(RandomStream& random, int count) {
    vehicle = belief.add_vehicle(Chart::line(12), Eigen::VectorXd::Zero(12), random_covariance(random, 12));
    for (int i = 0; i < count; ++i) {
      const Belief::Parent parent{vehicle, random_matrix(random, 3, 12)};
      landmarks.push_back(belief.augment(Chart::line(3), Eigen::VectorXd::Zero(3), {&parent, 1},
                                         random_covariance(random, 3)));
    }
  }
};

PredictedMeasurement random_measurement(RandomStream& random, const SmallMap& map, int of) {
  PredictedMeasurement measurement;
  measurement.Hv = random_matrix(random, 2, 12);
  measurement.R = random_covariance(random, 2);
  if (of < 0) return measurement;
  measurement.Hl = random_matrix(random, 2, 3);
  if (of < static_cast<int>(map.landmarks.size())) {
    measurement.of = PredictedMeasurement::Of::mapped;
    measurement.block = map.landmarks[static_cast<std::size_t>(of)];
  } else {
    measurement.of = PredictedMeasurement::Of::unseen;
    measurement.unseen = of - static_cast<int>(map.landmarks.size());
    measurement.unseen_var_m2 = unseen_var;
  }
  return measurement;
}

/// An anchor, some landmarks of the map, and one that is not initialized yet.
ImaginedStep random_step(RandomStream& random, const SmallMap& map) {
  ImaginedStep step{random_matrix(random, 12, 12) * 0.5, random_covariance(random, 12), {}};
  for (int of = -1; of < static_cast<int>(map.landmarks.size()) + unseen_count; ++of)
    if (random.below(3) > 0) step.measurements.push_back(random_measurement(random, map, of));
  return step;
}

/// The state augmented with the uninitialized landmarks (Figure 6.3), predicted and updated by the textbook
/// formulas.
struct Textbook {
  Eigen::MatrixXd P;
  int errors;

  explicit Textbook(const SmallMap& map) : errors(map.belief.errors()) {
    const int n = errors + 3 * unseen_count;
    P = unseen_var * Eigen::MatrixXd::Identity(n, n);
    P.topLeftCorner(errors, errors) = map.belief.dense_covariance();
  }
  void move(const ImaginedStep& step) {
    Eigen::MatrixXd F = Eigen::MatrixXd::Identity(P.rows(), P.cols());
    F.topLeftCorner(12, 12) = step.A;
    P = (F * P * F.transpose()).eval();
    P.topLeftCorner(12, 12) += step.N;
  }
  void update(const ImaginedStep& step, const SmallMap& map) {
    const auto rows = 2 * static_cast<Eigen::Index>(step.measurements.size());
    Eigen::MatrixXd H = Eigen::MatrixXd::Zero(rows, P.cols()), R = Eigen::MatrixXd::Zero(rows, rows);
    for (std::size_t i = 0; i < step.measurements.size(); ++i) {
      const PredictedMeasurement& measurement = step.measurements[i];
      const auto row = 2 * static_cast<Eigen::Index>(i);
      H.block(row, 0, 2, 12) = measurement.Hv;
      if (measurement.of == PredictedMeasurement::Of::mapped)
        H.block(row, map.belief.offset(measurement.block), 2, 3) = measurement.Hl;
      if (measurement.of == PredictedMeasurement::Of::unseen)
        H.block(row, errors + 3 * measurement.unseen, 2, 3) = measurement.Hl;
      R.block(row, row, 2, 2) = measurement.R;
    }
    const Eigen::MatrixXd S = H * P * H.transpose() + R;
    P = (P - P * H.transpose() * S.inverse() * H * P).eval();
  }
  /// log|P| without rows and columns [from, from + count).
  double log_det_without(int from, int count) const {
    const auto n = P.rows();
    std::vector<Eigen::Index> kept;
    for (Eigen::Index i = 0; i < n; ++i)
      if (i < from || i >= from + count) kept.push_back(i);
    return std::log(Eigen::MatrixXd(P(kept, kept)).determinant());
  }
};

TEST(InformationGain, EqualsTheThesisDeterminantsStepByStep) {
  RandomStream random(1, "test.information");
  for (int round = 0; round < 40; ++round) {
    const SmallMap map(random, 1 + random.below(4));
    Textbook textbook(map);
    InformationGain gain;
    gain.start(map.belief, map.vehicle);
    double wanted = 0;
    for (int k = 0; k < 3; ++k) {
      const ImaginedStep step = random_step(random, map);
      textbook.move(step);
      const double before = textbook.log_det_without(0, 0),
                   vehicle = log_det(textbook.P.topLeftCorner(12, 12));
      textbook.update(step, map);
      wanted += 0.5 * (before - textbook.log_det_without(0, 0));
      gain.push(step);
      EXPECT_NEAR(gain.of_state(), wanted, 1e-7 * (1 + wanted)) << "round " << round << " step " << k;
      if (k > 0) continue;
      EXPECT_NEAR(gain.of_vehicle(), 0.5 * (vehicle - log_det(textbook.P.topLeftCorner(12, 12))), 1e-7);
    }
  }
}

/// At the end of a path, the information on the vehicle is that of its last pose from all measurements along
/// the path.
TEST(InformationGain, OfTheVehicleIncludesAllMeasurementsOfThePath) {
  RandomStream random(7, "test.information");
  for (int round = 0; round < 20; ++round) {
    const SmallMap map(random, 3);
    Textbook seen(map), blind(map);
    InformationGain gain;
    gain.start(map.belief, map.vehicle);
    for (int k = 0; k < 3; ++k) {
      const ImaginedStep step = random_step(random, map);
      seen.move(step), blind.move(step);
      seen.update(step, map);
      gain.push(step);
    }
    const double wanted =
        0.5 * (log_det(blind.P.topLeftCorner(12, 12)) - log_det(seen.P.topLeftCorner(12, 12)));
    EXPECT_NEAR(gain.of_vehicle(), wanted, 1e-7 * (1 + wanted));
    EXPECT_LE(gain.of_vehicle(), gain.of_state());
  }
}

TEST(InformationGain, OfPositionAndMapMarginalizesTheRest) {
  RandomStream random(5, "test.information");
  constexpr int kept = 3;
  for (int round = 0; round < 20; ++round) {
    const SmallMap map(random, 2);
    const ImaginedStep step = random_step(random, map);
    InformationGain gain;
    gain.start(map.belief, map.vehicle);
    gain.push(step);
    Textbook textbook(map);
    textbook.move(step);
    const double before = textbook.log_det_without(kept, 12 - kept);
    textbook.update(step, map);
    const double wanted = 0.5 * (before - textbook.log_det_without(kept, 12 - kept));
    const BlockMatrix given = vehicle_given_map(map.belief, map.vehicle);
    EXPECT_NEAR(gain.of_position_and_map(kept, given), wanted, 1e-7 * (1 + wanted));
    EXPECT_NEAR(gain.of_position_and_map(12, given), gain.of_state(), 1e-9) << "nothing is left out";
  }
}

TEST(InformationGain, DoesNotDependOnTheOrderOfEvaluation) {
  RandomStream random(6, "test.information");
  const SmallMap map(random, 4);
  const AnyBelief same = AnyBelief(map.belief);
  std::vector<ImaginedStep> steps;
  for (int i = 0; i < 4; ++i) steps.push_back(random_step(random, map));
  InformationGain straight, wandering;
  straight.start(map.belief, map.vehicle);
  wandering.start(same, map.vehicle);
  for (const int k : {0, 1}) straight.push(steps[static_cast<std::size_t>(k)]);
  wandering.push(steps[2]), wandering.push(steps[3]);
  wandering.pop(), wandering.pop();
  wandering.push(steps[0]), wandering.push(steps[3]);
  wandering.pop();
  wandering.push(steps[1]);
  EXPECT_EQ(wandering.of_state(), straight.of_state());
  EXPECT_EQ(wandering.of_vehicle(), straight.of_vehicle());
  EXPECT_EQ(wandering.fisher_trace(), straight.fisher_trace());
  EXPECT_EQ(wandering.steps(), 2);
  wandering.start(map.belief, map.vehicle);
  EXPECT_EQ(wandering.of_state(), 0);
  EXPECT_THROW(wandering.pop(), std::logic_error);
}

TEST(InformationGain, IsZeroWithoutMeasurementsAndGrowsWithThem) {
  RandomStream random(2, "test.information");
  const SmallMap map(random, 5);
  const ImaginedStep all = random_step(random, map);
  ImaginedStep some{all.A, all.N, {}};
  double before = -1;
  for (std::size_t count = 0; count <= all.measurements.size(); ++count) {
    some.measurements.assign(all.measurements.begin(),
                             all.measurements.begin() + static_cast<std::ptrdiff_t>(count));
    InformationGain gain;
    gain.start(map.belief, map.vehicle);
    gain.push(some);
    EXPECT_GT(gain.of_state(), before);
    if (count == 0) {
      EXPECT_EQ(gain.of_state(), 0);
      EXPECT_EQ(gain.of_vehicle(), 0);
      EXPECT_EQ(gain.fisher_trace(), 0);
    }
    before = gain.of_state();
  }
}

TEST(InformationGain, FisherTraceIsThatOfTheWholeMatrices) {
  RandomStream random(8, "test.information");
  const SmallMap map(random, 3);
  ImaginedStep step = random_step(random, map);
  InformationGain gain;
  gain.start(map.belief, map.vehicle);
  gain.push(step);
  double thesis = 0, given_state = 0;
  for (const PredictedMeasurement& measurement : step.measurements) {
    Eigen::MatrixXd H(2, 12 + measurement.Hl.cols());
    H << measurement.Hv, measurement.Hl;
    ImaginedStep alone{step.A, step.N, {measurement}};
    Textbook textbook(map);
    textbook.move(alone);
    std::vector<Eigen::Index> errors;
    for (int i = 0; i < 12; ++i) errors.push_back(i);
    const int at = measurement.of == PredictedMeasurement::Of::mapped ? map.belief.offset(measurement.block)
                   : measurement.of == PredictedMeasurement::Of::unseen
                       ? textbook.errors + 3 * measurement.unseen
                       : -1;
    for (int i = 0; at >= 0 && i < 3; ++i) errors.push_back(at + i);
    const Eigen::MatrixXd S = H * textbook.P(errors, errors) * H.transpose() + Eigen::MatrixXd(measurement.R);
    thesis += (H.transpose() * S.inverse() * H).trace();
    given_state += (H.transpose() * Eigen::MatrixXd(measurement.R).inverse() * H).trace();
  }
  EXPECT_NEAR(gain.fisher_trace(), thesis, 1e-9 * thesis);
  EXPECT_NEAR(gain.fisher_trace_given_state(), given_state, 1e-9 * given_state);
  EXPECT_LT(gain.fisher_trace(), gain.fisher_trace_given_state());
}

TEST(InformationGain, IsFiniteWhereDeterminantsUnderflow) {
  // |1e-4 I| of 313 states is 0 in double precision: the thesis' formula has no value, this one has
  RandomStream random(3, "test.information");
  SmallMap map(random, 0);
  for (int i = 0; i < 101; ++i)
    map.landmarks.push_back(map.belief.augment(Chart::line(3), Eigen::VectorXd::Zero(3), {},
                                               1e-4 * Eigen::MatrixXd::Identity(3, 3)));
  ASSERT_EQ(map.belief.dense_covariance().determinant(), 0);
  ImaginedStep step{Eigen::MatrixXd::Identity(12, 12), Eigen::MatrixXd::Zero(12, 12), {}};
  std::vector<LinearizedMeasurement> measurements;
  for (int of = 0; of < 101; ++of) {
    step.measurements.push_back(random_measurement(random, map, of));
    LinearizedMeasurement measurement;
    measurement.add(map.vehicle, step.measurements.back().Hv);
    measurement.add(step.measurements.back().block, step.measurements.back().Hl);
    measurement.residual = Eigen::Vector2d::Zero();
    measurement.R = step.measurements.back().R;
    measurements.push_back(measurement);
  }
  InformationGain gain;
  gain.start(map.belief, map.vehicle);
  gain.push(step);
  AnyBelief updated = map.belief;
  const UpdateReport report = updated.update(measurements);
  EXPECT_NEAR(gain.of_state(), 0.5 * (report.log_det_S - report.log_det_R), 1e-7);
  EXPECT_NEAR(gain.of_state(),
              0.5 * (log_det(map.belief.dense_covariance()) - log_det(updated.dense_covariance())), 1e-6);
}

TEST(InformationGain, RefusesWrongSizes) {
  RandomStream random(9, "test.information");
  const SmallMap map(random, 2);
  InformationGain gain;
  gain.start(map.belief, map.vehicle);
  ImaginedStep step = random_step(random, map);
  step.A = Eigen::MatrixXd::Identity(3, 3);
  EXPECT_THROW(gain.push(step), std::invalid_argument);
  step = {
      Eigen::MatrixXd::Identity(12, 12), Eigen::MatrixXd::Zero(12, 12), {random_measurement(random, map, 0)}};
  step.measurements[0].Hl = random_matrix(random, 2, 4);
  EXPECT_THROW(gain.push(step), std::invalid_argument);
  step.measurements = {random_measurement(random, map, 0)};
  step.measurements[0].Hv = random_matrix(random, 2, 6);
  gain.start(map.belief, map.vehicle);
  EXPECT_THROW(gain.push(step), std::invalid_argument);
}

/// The covariance is singular; an exact error has no information to gain.
TEST(InformationGain, OfAVehicleWithOneExactAxis) {
  AnyBelief belief;
  const Eigen::Matrix2d P = Eigen::Vector2d(0, 0.04).asDiagonal();
  const BlockId vehicle = belief.add_vehicle(Chart::line(2), Eigen::Vector2d::Zero(), P);
  PredictedMeasurement measurement;
  measurement.Hv = MeasurementJacobian::Identity(2, 2);
  measurement.Hl.resize(2, 0);
  measurement.R = 0.01 * MeasurementMatrix::Identity(2, 2);
  InformationGain gain;
  gain.start(belief, vehicle);
  gain.push({BlockMatrix::Identity(2, 2), BlockMatrix::Zero(2, 2), {measurement}});
  EXPECT_NEAR(gain.of_vehicle(), 0.5 * std::log(1 + 0.04 / 0.01), 1e-12);
  EXPECT_NEAR(gain.of_vehicle(), gain.of_state(), 1e-12);
  EXPECT_THROW(gain.of_position_and_map(3, P), std::invalid_argument);
  EXPECT_THROW(gain.of_position_and_map(-1, P), std::invalid_argument);
  EXPECT_NEAR(gain.of_position_and_map(0, P), 0, 1e-12) << "there is no map to gain information on";
  EXPECT_NEAR(gain.of_position_and_map(2, P), gain.of_state(), 1e-12) << "all of it";
}

}  // namespace
}  // namespace incognita
