// Landmark initialization for any sensor on any vehicle: the inverse of the measurement model, with Jacobians
// equal to finite differences through the charts.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "tests/models/sensor_cases.hpp"

namespace incognita {
namespace {

using namespace sensor_cases;

/// Change of an initialized landmark to the axes of another initialization, which stay constant under errors
/// of the pose. `keep`: the inverse depth is prior knowledge along those axes and keeps its value.
SmallVector chart_transition_jacobian(const AnyInitialization& initialized, const AnyInitialization& in,
                                      bool keep) {
  if (initialized.landmark.size() != 6) return initialized.landmark;
  const Eigen::Matrix3d turn = rotation_matrix<double>(in.form.initial_axes).transpose() *
                               rotation_matrix<double>(initialized.form.initial_axes);
  const Eigen::Vector3d ray = turn * Eigen::Vector3d(initialized.landmark[3], initialized.landmark[4], 1);
  SmallVector y = initialized.landmark;
  y.segment<2>(3) = ray.head<2>() / ray.z();
  if (!keep) y[5] /= ray.z();
  return y;
}

/// A vehicle and what its sensor measures of a point.
void for_every_initialization(
    const std::function<void(const Case&, const SmallVector& z, const AnyInitialization&)>& with) {
  int tried = 0;
  for_every_case([&](const Case& c) {
    const auto prediction = c.predict();
    if (c.point.size() == 0 || c.form.kind != LandmarkParametrization::Kind::point || !prediction ||
        !is_in_view(c.sensor, {}, *prediction, 0))
      return;
    const auto* stereo = std::get_if<StereoSensor>(&c.sensor);
    const bool no_disparity =
        stereo && !(prediction->z[0] - prediction->z[2] > stereo->stereo.least_disparity_px);
    const auto initialized = initialize_landmark(c.sensor, c.motion, c.vehicle, prediction->z, 0.25);
    ASSERT_EQ(initialized.has_value(), !no_disparity) << c.name();
    if (initialized) with(c, prediction->z, *initialized), ++tried;
  });
  EXPECT_GT(tried, 300);
}

TEST(AnySensor, InitializationIsTheInverseOfTheMeasurement) {
  for_every_initialization([](const Case& c, const SmallVector& z, const AnyInitialization& initialized) {
    const auto again =
        predict_measurement(c.sensor, c.motion, c.vehicle, initialized.form, initialized.landmark);
    ASSERT_TRUE(again) << c.name();
    EXPECT_LE(minus(chart_of(c.sensor), again->z, z).norm(), 1e-7) << c.name();
    // To first order too: a pose error displaces the landmark so that the predicted measurement stays
    const SmallMatrix stays = again->Hv + again->Hl * initialized.Jv;
    EXPECT_LE(stays.norm(), 1e-8 * (1 + again->Hv.norm())) << c.name();
    const SmallMatrix as_seen = again->Hl * initialized.Jz;
    EXPECT_LE((as_seen - SmallMatrix::Identity(z.size(), z.size())).norm(), 1e-8) << c.name();
    EXPECT_EQ(initialized.Jd.size() == 0, measures_distance(c.sensor));
    if (!measures_distance(c.sensor)) {
      EXPECT_LE((again->Hl * initialized.Jd).norm(), 1e-12)
          << "the distance is unobservable from the initial pose";
      EXPECT_EQ(initialized.landmark[initialized.landmark.size() - 1], 0.25);
      return;
    }
    const auto point = position_of(initialized.form, initialized.landmark);
    ASSERT_TRUE(point);
    const double away = (c.point - position_of(c.motion, c.vehicle).position).norm();
    EXPECT_LE((point->position - c.point).norm(), 1e-8 * (1 + away * away)) << c.name();
  });
}

TEST(AnySensor, InitializationJacobiansEqualDifferences) {
  for_every_initialization([](const Case& c, const SmallVector& z, const AnyInitialization& initialized) {
    const bool keep = !measures_distance(c.sensor);
    const auto initialization = [&](const SmallVector& x, const SmallVector& seen, double inverse) {
      return chart_transition_jacobian(*initialize_landmark(c.sensor, c.motion, x, seen, inverse),
                                       initialized, keep);
    };
    // One pixel of disparity changes the distance: the truncation error of differences grows with its inverse
    const double disparity = z.size() == 3 ? z[0] - z[2] : 1e9;
    if (disparity < 2) return;
    expect_jacobian(initialized.Jv,
                    differences(
                        chart_of(c.motion), c.vehicle, initialized.chart,
                        [&](const SmallVector& x) { return initialization(x, z, 0.25); }, 3e-4),
                    "Jv, " + c.name());
    expect_jacobian(initialized.Jz,
                    differences(
                        chart_of(c.sensor), z, initialized.chart,
                        [&](const SmallVector& seen) { return initialization(c.vehicle, seen, 0.25); },
                        z.size() > 1 ? 3e-2 * std::min(1.0, c.away_m) : 3e-4),
                    "Jz, " + c.name());
    if (!keep) return;
    expect_jacobian(initialized.Jd,
                    differences(
                        Chart::line(1), vec({0.25}), initialized.chart,
                        [&](const SmallVector& d) { return initialization(c.vehicle, z, d[0]); }, 3e-4),
                    "Jd, " + c.name());
  });
}

}  // namespace
}  // namespace incognita
