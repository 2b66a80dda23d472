// Any sensor on any vehicle that it fits: correct measurements, Jacobians equal to finite differences through
// the charts, and refusals with a reason.
#include "incognita/models/any_sensor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/models/sensor_cases.hpp"

namespace incognita {
namespace {

using namespace sensor_cases;

/// Expected measurement of a point, by the names of its components; NAN for a name without an expected value
/// here.
struct Expected {
  SmallVector z;
  bool in_view = true;
};
Expected expected_of(const Case& c) {
  const auto measurement = traits_of(c.sensor).measurement;
  Expected expected{SmallVector::Constant(static_cast<Eigen::Index>(measurement.size()), NAN)};
  const auto set = [&](const char* name, double value) {
    for (std::size_t i = 0; i < measurement.size(); ++i)
      if (measurement[i].name == name) expected.z[static_cast<Eigen::Index>(i)] = value;
  };
  if (c.point.size() == 1) set("position", c.point[0] - c.vehicle[0]);
  if (c.point.size() == 2) {
    const Eigen::Vector2d way = c.point - c.vehicle.head(2);
    set("range", way.norm());
    set("bearing", std::atan2(way.y(), way.x()) - c.vehicle[2]);
  }
  if (c.point.size() != 3) return expected;
  const Camera lens = *lens_of(c.sensor);
  const Eigen::Vector3d seen = lens_on(c.motion, c.vehicle).in_camera(c.point);
  const Eigen::Vector2d pixel = lens.project(seen)->pixel;
  set("u", pixel.x()), set("v", pixel.y());
  expected.in_view = lens.contains(pixel);
  if (const auto* two = std::get_if<StereoSensor>(&c.sensor)) {
    const Eigen::Vector2d other =
        lens.project(seen - two->stereo.baseline_m * Eigen::Vector3d::UnitX())->pixel;
    set("u_right", other.x());
    expected.in_view = expected.in_view && lens.contains(other);
  }
  return expected;
}

TEST(AnySensor, MeasurementsHaveTheExpectedValues) {
  for_every_case([](const Case& c) {
    if (c.point.size() == 0) return;
    const auto prediction = c.predict();
    ASSERT_TRUE(prediction) << c.name();
    EXPECT_TRUE(is_possible(c.sensor, prediction->z) || !is_in_view(c.sensor, {}, *prediction, 0))
        << c.name();
    const Expected expected = expected_of(c);
    EXPECT_EQ(prediction->in_view, expected.in_view) << c.name();
    if (!expected.z.allFinite()) return;
    EXPECT_LE(minus(chart_of(c.sensor), prediction->z, expected.z).norm(), 1e-9 * (1 + expected.z.norm()))
        << c.name();
    if (c.point.size() == 2) {
      EXPECT_LE(std::abs(prediction->z[prediction->z.size() - 1]), pi);
    }
  });
}

TEST(AnySensor, MeasurementJacobiansEqualDifferences) {
  for_every_case([](const Case& c) {
    const auto prediction = c.predict();
    ASSERT_TRUE(prediction) << c.name();
    const Chart& chart = chart_of(c.sensor);
    const double step = 3e-4 * c.away_m;
    expect_jacobian(prediction->Hv,
                    differences(
                        chart_of(c.motion), c.vehicle, chart,
                        [&](const SmallVector& x) {
                          return predict_measurement(c.sensor, c.motion, x, c.form, c.landmark)->z;
                        },
                        step),
                    "Hv, " + c.name());
    expect_jacobian(prediction->Hl,
                    differences(
                        c.chart, c.landmark, chart,
                        [&](const SmallVector& y) {
                          return predict_measurement(c.sensor, c.motion, c.vehicle, c.form, y)->z;
                        },
                        step),
                    "Hl, " + c.name());
  });
}
TEST(AnySensor, RefusesWhatIsOutsideItsFieldOfView) {
  for (const AnyMotion& motion : motions())
    for (const AnySensor& sensor : sensors()) {
      if (!incompatibility(motion, sensor).empty() || dimensions_of(sensor) == 1) continue;
      for (const SmallVector& x : states(motion)) {
        if (dimensions_of(sensor) == 2) {
          EXPECT_FALSE(predict_measurement(sensor, motion, x, {}, x.head(2))) << "where the sensor is";
          continue;
        }
        const Lens lens = lens_on(motion, x);
        for (const Eigen::Vector3d& c :
             {Eigen::Vector3d(0, 0, -1), Eigen::Vector3d(0.3, 0.2, -5), Eigen::Vector3d(0, 0, 0)})
          EXPECT_FALSE(predict_measurement(sensor, motion, x, {}, lens.in_world(c))) << "behind the lens";
      }
    }
}

TEST(AnySensor, PositionJacobiansEqualDifferences) {
  for (const AnyMotion& motion : motions())
    for (const SmallVector& x : states(motion)) {
      const AnyPoint at = position_of(motion, x);
      const int size = static_cast<int>(at.position.size());
      EXPECT_EQ(at.position, SmallVector(pose_of(motion, x).position.head(size)));
      expect_jacobian(at.J,
                      differences(
                          chart_of(motion), x, Chart::line(size),
                          [&](const SmallVector& y) { return position_of(motion, y).position; }, 3e-4),
                      "a vehicle's position");
    }
  for_every_case([](const Case& c) {
    const auto at = position_of(c.form, c.landmark);
    ASSERT_EQ(at.has_value(),
              c.form.kind == LandmarkParametrization::Kind::point || c.landmark[c.landmark.size() - 1] > 0);
    if (c.point.size() == 0) return;
    EXPECT_LE((at->position - c.point).norm(), 1e-12 * (1 + c.point.norm())) << c.name();
    const bool point = c.form.kind == LandmarkParametrization::Kind::point;
    const double step = point ? 1e-3 : 1e-3 * std::min(1.0, c.landmark[c.landmark.size() - 1]);
    expect_jacobian(at->J,
                    differences(
                        c.chart, c.landmark, Chart::line(static_cast<int>(c.point.size())),
                        [&](const SmallVector& y) { return position_of(c.form, y)->position; }, step),
                    "a landmark's position, " + c.name());
  });
}

TEST(AnySensor, APlanarVehicleIsAtHeightZero) {
  for (const AnyMotion& motion : motions())
    for (const SmallVector& x : states(motion))
      for (const int dimensions : {1, 2, 3}) {
        const AnyPoint own = position_of(motion, x), at = position_of(motion, x, dimensions);
        EXPECT_EQ(at.position, SmallVector(pose_of(motion, x).position.head(dimensions)));
        ASSERT_EQ(at.J.rows(), dimensions);
        for (Eigen::Index i = 0; i < dimensions; ++i)
          EXPECT_EQ(at.J.row(i),
                    i < own.J.rows() ? SmallMatrix(own.J.row(i)) : SmallMatrix::Zero(1, own.J.cols()));
      }
}

TEST(AnySensor, LinearityIndexIsFourSigmaOverDistanceTimesCosineOfParallax) {
  const LandmarkParametrization far{LandmarkParametrization::Kind::inverse_depth, {1, 0, 0, 0}};
  const double sigma = 0.01, d = 4, spread_m = sigma * d * d;  // sigma of the distance
  const SmallVector on_plane = vec({1, 2, 0, 1 / d}),
                    in_space = vec({1, 2, 3, 0, 0, 1 / d});  // along +x, along +z
  const auto index = [&](const SmallVector& y, const SmallVector& from) {
    return linearity_index(far, y, sigma * sigma, from);
  };
  EXPECT_EQ(linearity_index({}, vec({1, 2}), sigma * sigma, vec({0, 0})), 0) << "zero for a point";
  EXPECT_NEAR(index(on_plane, vec({1, 2})), 4 * spread_m / d, 1e-12) << "from the initial pose";
  EXPECT_NEAR(index(in_space, vec({1, 2, 3})), 4 * spread_m / d, 1e-12);
  EXPECT_NEAR(index(on_plane, vec({1 + d, 7})), 0, 1e-12) << "at a right angle the distance is observable";
  EXPECT_NEAR(index(in_space, vec({1, 9, 3 + d})), 0, 1e-12);
  const double c = std::cos(1.0), s = std::sin(1.0);  // 2 m away, parallax 1 rad
  EXPECT_NEAR(index(on_plane, vec({1 + d - 2 * c, 2 + 2 * s})), 4 * spread_m / 2 * c, 1e-12);
  EXPECT_NEAR(index(in_space, vec({1, 2 + 2 * s, 3 + d - 2 * c})), 4 * spread_m / 2 * c, 1e-12);
  for (const double inverse : {0.0, -0.1}) {
    EXPECT_GT(index(vec({1, 2, 0, inverse}), vec({0, 0})), 1e6) << "a landmark at infinity is not converted";
    EXPECT_GT(index(vec({1, 2, 3, 0, 0, inverse}), vec({0, 0, 0})), 1e6);
  }
}

TEST(AnySensor, IncompatibleVehicleIsRefusedWithTheReason) {
  const auto sensor_list = sensors();
  for (const AnyMotion& motion : motions())
    for (const AnySensor& sensor : sensor_list) {
      const std::string why = incompatibility(motion, sensor);
      if (dimensions_of(traits_of(motion).space) < dimensions_of(sensor) && !traits_of(motion).on_plane()) {
        EXPECT_FALSE(why.empty()) << traits_of(motion).name << ", " << traits_of(sensor).name;
      }
      if (dimensions_of(traits_of(motion).space) == dimensions_of(sensor)) {
        EXPECT_EQ(why, "") << traits_of(motion).name << ", " << traits_of(sensor).name;
      }
      if (!why.empty()) {
        EXPECT_GT(why.size(), 40u) << "the reason as a sentence";
      }
    }
  const auto says = [](const AnyMotion& motion, const AnySensor& sensor, const char* part) {
    EXPECT_NE(incompatibility(motion, sensor).find(part), std::string::npos)
        << incompatibility(motion, sensor);
  };
  says(MonobotMotion{}, BearingSensor{}, "a bearing has no information");
  says(DifferentialDrive{}, RelativePositionSensor{}, "needs a vehicle on a line");
  says(FreeCameraMotion{}, RelativePositionSensor{}, "needs a vehicle on a line");
  says(FreeCameraMotion{}, RangeBearingSensor{}, "cannot localize a body in space");
  says(TerrainVehicle{}, BearingSensor{}, "tilts with the vehicle");
}

}  // namespace
}  // namespace incognita
