// Decisions of a vehicle: by predicted measurements, from its present speeds, and back inside after it left
// its bounds.
#include "incognita/decision/carrier_choice.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "incognita/models/motion/heading.hpp"

namespace incognita {
namespace {

constexpr double sigma = 0.3;

/// A landmark that is measured more accurately the nearer the camera is to a point; none if there is no
/// point.
class Beacon final : public Expectation {
 public:
  std::optional<Eigen::Vector3d> position;
  void expect(const BlockVector& state, std::vector<PredictedMeasurement>& measurements) const override {
    measurements.clear();
    if (!position) return;
    PredictedMeasurement measurement;
    measurement.of = PredictedMeasurement::Of::anchor;
    measurement.Hv = MeasurementJacobian::Zero(3, 12);
    measurement.Hv.leftCols<3>().setIdentity();
    measurement.Hl.resize(3, 0);
    measurement.R =
        (0.01 + (*position - state.head<3>()).squaredNorm()) * MeasurementJacobian::Identity(3, 3);
    measurements.push_back(measurement);
  }
};

CameraState level_camera() {
  CameraState x = CameraState::Zero();
  x.head<3>() << 0, 0, 0.6;
  x.segment<4>(3) = level_gaze(0);
  return x;
}

struct Driven {
  AnyBelief belief;
  DecisionSettings settings;
  Beacon beacon;
  Body body;

  Driven() {
    body.block = belief.add_vehicle(FreeCameraMotion::chart, level_camera(),
                                    SmallMatrix(0.1 * SmallMatrix::Identity(12, 12)));
    settings.impulse_s = 1;  // 0.5 m/s and 0.3 rad/s in one decision
  }
  BodyGoal first() {
    CarrierChoice choice(settings, CarrierSettings{}, sigma, sigma, 1);
    BodyGoal goal;
    Tick tick;
    tick.frame = 0;
    choice.choose(belief, body, beacon, {}, tick, goal);
    return goal;
  }
};

TEST(CarrierChoice, DrivesToTheGreatestGain) {
  Driven d;
  d.beacon.position = Eigen::Vector3d(-2, 0, 0.6);
  const BodyGoal back = d.first();
  EXPECT_EQ(*back.drive, Eigen::Vector2d(-0.5, 0));
  EXPECT_NEAR((back.to - Eigen::Vector3d(-0.5, 0, 0.6)).norm(), 0, 1e-12);
  d.beacon.position = Eigen::Vector3d(2, 0, 0.6);
  EXPECT_EQ(*d.first().drive, Eigen::Vector2d(0.5, 0));
}

TEST(CarrierChoice, ChangesTheSpeedsMeasuredByTheWheels) {
  Driven d;
  d.beacon.position = Eigen::Vector3d(-2, 0, 0.6);
  d.body.wheels = Eigen::Vector2d(0.3, 0);
  EXPECT_NEAR((*d.first().drive - Eigen::Vector2d(-0.2, 0)).norm(), 0, 1e-12);
}

/// It cannot stop immediately: when every action ends out of bounds, it takes the one that ends nearest to
/// them, whatever the gain.
TEST(CarrierChoice, ReturnsWhenEveryActionEndsOutOfBounds) {
  Driven d;
  d.settings.min_bound_m = {-9, -9, -9};
  d.settings.max_bound_m = {0.1, 9, 9};
  d.body.wheels = Eigen::Vector2d(0.9, 0);
  d.beacon.position = Eigen::Vector3d(2, 0, 0.6);
  const BodyGoal goal = d.first();
  EXPECT_NEAR(goal.drive->x(), 0.4, 1e-12);
  EXPECT_GT(goal.to.x(), 0.1) << "it ends out of bounds";
}

TEST(CarrierChoice, BoundsOfTheHeightDoNotApply) {
  Driven d;
  d.settings.min_bound_m = {-9, -9, 2};
  d.settings.max_bound_m = {9, 9, 3};
  d.beacon.position = Eigen::Vector3d(-2, 0, 0.6);
  EXPECT_EQ(*d.first().drive, Eigen::Vector2d(-0.5, 0));
}

TEST(CarrierChoice, KeepsItsSpeedsWhereNothingIsPredicted) {
  Driven d;
  d.body.wheels = Eigen::Vector2d(0.2, 0.1);
  const BodyGoal goal = d.first();
  EXPECT_EQ(*goal.drive, Eigen::Vector2d(0.2, 0.1));
}

TEST(CarrierChoice, StopsAfterTheEstimateWasLost) {
  Driven d;
  d.beacon.position = Eigen::Vector3d(2, 0, 0.6);
  CarrierChoice choice(d.settings, CarrierSettings{}, sigma, sigma, 1);
  BodyGoal goal;
  Tick tick;
  tick.frame = 0;
  choice.choose(d.belief, d.body, d.beacon, {}, tick, goal);
  ASSERT_EQ(*goal.drive, Eigen::Vector2d(0.5, 0));
  choice.forget();
  d.beacon.position.reset();
  choice.choose(d.belief, d.body, d.beacon, {}, tick, goal);
  EXPECT_EQ(*goal.drive, Eigen::Vector2d(0, 0));
}

TEST(CarrierChoice, AcceptsAUserActionSet) {
  Driven d;
  d.settings.accelerations = {{0, 0}, {0.1, 0}, {0, 0.2}};
  const CarrierChoice choice(d.settings, CarrierSettings{}, sigma, sigma, 1);
  EXPECT_EQ(choice.names(), (std::vector<std::string>{"stay", "faster", "left"}));
  d.settings.accelerations = {{0.1, 0}};
  EXPECT_THROW(CarrierChoice(d.settings, CarrierSettings{}, sigma, sigma, 1), std::invalid_argument);
}

}  // namespace
}  // namespace incognita
