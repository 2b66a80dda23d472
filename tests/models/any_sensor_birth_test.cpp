// Landmarks born from what any sensor on any vehicle sees: being born undoes being seen, and the Jacobians
// are those of differences through the charts.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "tests/models/sensor_cases.hpp"

namespace incognita {
namespace {

using namespace sensor_cases;

/// A landmark told along the axes of another's birth, which are a constant while all else errs. `keep`: its
/// inverse depth is what is known beforehand, and that is known along those axes.
SmallVector retold(const AnyBirth& born, const AnyBirth& in, bool keep) {
  if (born.landmark.size() != 6) return born.landmark;
  const Eigen::Matrix3d turn =
      rotation_matrix<double>(in.form.birth_axes).transpose() * rotation_matrix<double>(born.form.birth_axes);
  const Eigen::Vector3d ray = turn * Eigen::Vector3d(born.landmark[3], born.landmark[4], 1);
  SmallVector y = born.landmark;
  y.segment<2>(3) = ray.head<2>() / ray.z();
  if (!keep) y[5] /= ray.z();
  return y;
}

/// A vehicle and what its sensor measured of a point.
void for_every_birth(const std::function<void(const Case&, const SmallVector& z, const AnyBirth&)>& with) {
  int tried = 0;
  for_every_case([&](const Case& c) {
    const auto look = c.look();
    if (c.point.size() == 0 || c.form.kind != LandmarkForm::Kind::point || !look || !look->in_view) return;
    const auto* stereo = std::get_if<CarriedStereo>(&c.sensor);
    const bool no_disparity = stereo && !(look->z[0] - look->z[2] > stereo->stereo.least_disparity_px);
    const auto born = birth_from(c.sensor, c.motion, c.vehicle, look->z, 0.25);
    ASSERT_EQ(born.has_value(), !no_disparity) << c.name();
    if (born) with(c, look->z, *born), ++tried;
  });
  EXPECT_GT(tried, 300);
}

TEST(AnySensor, BeingBornUndoesBeingSeen) {
  for_every_birth([](const Case& c, const SmallVector& z, const AnyBirth& born) {
    const auto again = look_at(c.sensor, c.motion, c.vehicle, born.form, born.landmark);
    ASSERT_TRUE(again) << c.name();
    EXPECT_LE(minus(chart_of(c.sensor), again->z, z).norm(), 1e-7) << c.name();
    // To first order too: a vehicle that errs carries its landmark along, so that it is seen where it was
    const SmallMatrix stays = again->Hv + again->Hl * born.Jv;
    EXPECT_LE(stays.norm(), 1e-8 * (1 + again->Hv.norm())) << c.name();
    const SmallMatrix as_seen = again->Hl * born.Jz;
    EXPECT_LE((as_seen - SmallMatrix::Identity(z.size(), z.size())).norm(), 1e-8) << c.name();
    EXPECT_EQ(born.Jd.size() == 0, tells_distance(c.sensor));
    if (!tells_distance(c.sensor)) {
      EXPECT_LE((again->Hl * born.Jd).norm(), 1e-12) << "the distance is not seen from where it was born";
      EXPECT_EQ(born.landmark[born.landmark.size() - 1], 0.25);
      return;
    }
    const auto point = position_of(born.form, born.landmark);
    ASSERT_TRUE(point);
    const double away = (c.point - position_of(c.motion, c.vehicle).position).norm();
    EXPECT_LE((point->position - c.point).norm(), 1e-8 * (1 + away * away)) << c.name();
  });
}

TEST(AnySensor, BirthsHaveTheJacobiansOfDifferences) {
  for_every_birth([](const Case& c, const SmallVector& z, const AnyBirth& born) {
    const bool keep = !tells_distance(c.sensor);
    const auto birth = [&](const SmallVector& x, const SmallVector& seen, double inverse) {
      return retold(*birth_from(c.sensor, c.motion, x, seen, inverse), born, keep);
    };
    // A disparity of a pixel more or less is another place: what differences miss grows with its inverse
    const double disparity = z.size() == 3 ? z[0] - z[2] : 1e9;
    if (disparity < 2) return;
    expect_jacobian(born.Jv,
                    differences(
                        chart_of(c.motion), c.vehicle, born.chart,
                        [&](const SmallVector& x) { return birth(x, z, 0.25); }, 3e-4),
                    "Jv, " + c.name());
    expect_jacobian(born.Jz,
                    differences(
                        chart_of(c.sensor), z, born.chart,
                        [&](const SmallVector& seen) { return birth(c.vehicle, seen, 0.25); },
                        z.size() > 1 ? 3e-2 * std::min(1.0, c.away_m) : 3e-4),
                    "Jz, " + c.name());
    if (!keep) return;
    expect_jacobian(born.Jd,
                    differences(
                        Chart::line(1), vec({0.25}), born.chart,
                        [&](const SmallVector& d) { return birth(c.vehicle, z, d[0]); }, 3e-4),
                    "Jd, " + c.name());
  });
}

}  // namespace
}  // namespace incognita
