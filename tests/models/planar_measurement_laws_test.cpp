// Properties of every measurement from a planar pose. A new model is added by one line in the list below.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <numbers>
#include <vector>

#include "incognita/models/sensors/bearing.hpp"
#include "incognita/models/sensors/range_bearing.hpp"
#include "tests/models/dual.hpp"

namespace incognita {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// A model with its landmark at a range and a bearing (m, rad) from a pose, in the model's own
/// parametrization.
template <class M>
struct AsPoint : M {
  static constexpr int landmark_size = 2;
  static std::vector<Vector2d> landmarks(const Vector3d& pose, const Vector2d& z) {
    return {RangeBearing::j<double>(pose, z)};
  }
};
struct AsInverseDistance : PlanarInverseDistance {
  static constexpr int landmark_size = 4;
  /// Initialized here, initialized at a small and a large distance, and infinitely far in that direction.
  static std::vector<State<double>> landmarks(const Vector3d& pose, const Vector2d& z) {
    const Vector2d at = RangeBearing::j<double>(pose, z);
    std::vector<State<double>> all;
    for (const Vector2d& from : {Vector2d(0, 0), Vector2d(0.3, -0.4), Vector2d(-50, 20)}) {
      const Vector2d initialization = pose.head<2>() + from, way = at - initialization;
      all.push_back({initialization.x(), initialization.y(), std::atan2(way.y(), way.x()), 1 / way.norm()});
    }
    all.push_back({pose[0] + 3, pose[1], pose[2] + z[1], 0});
    all.push_back({pose[0] + 0.3, pose[1] + 0.1, pose[2] + z[1], -1e-3});  // an update has overshot infinity
    return all;
  }
};

using Measurements = ::testing::Types<  //
    AsPoint<RangeBearing>,              //
    AsPoint<Bearing>,                   //
    AsInverseDistance                   //
    >;

template <class M>
class PlanarMeasurementLaws : public ::testing::Test {
 protected:
  /// Calls with(pose, landmark): ahead, abeam, behind on either side of the wrap, at a micrometer and at a
  /// hundred kilometers.
  template <class F>
  static void at_nasty_places(F with) {
    constexpr double pi = std::numbers::pi;
    for (const Vector3d& pose : {Vector3d(0, 0, 0), Vector3d(1, -2, pi), Vector3d(-3, 4, -3.1415),
                                 Vector3d(0.1, 0.2, pi / 2), Vector3d(7, 7, -2)})
      for (const double range : {2e-6, 1e-3, 1.0, 30.0, 1e5})
        for (const double bearing : {0.0, 1e-9, 0.7, pi / 2, -pi / 2, pi - 1e-7, -pi + 1e-7, pi, -2.5})
          for (const auto& landmark : M::landmarks(pose, {range, bearing})) with(pose, landmark);
  }
};

TYPED_TEST_SUITE(PlanarMeasurementLaws, Measurements);

TYPED_TEST(PlanarMeasurementLaws, JacobiansAreExact) {
  constexpr int size = TypeParam::landmark_size, all = 3 + size;
  int tried = 0;
  this->at_nasty_places([&](const Vector3d& pose, const Eigen::Matrix<double, size, 1>& landmark) {
    const auto prediction = TypeParam::predict_measurement(pose, landmark);
    if (!prediction) return;
    ++tried;
    constexpr int rows = decltype(prediction->z)::RowsAtCompileTime;
    const auto z = TypeParam::template h<Dual<all>>(variables<all>(pose), variables<all>(landmark, 3));
    const auto J = derivatives<all, rows>(z);
    EXPECT_LE((prediction->z - values<all, rows>(z)).norm(), 1e-15 * (1 + prediction->z.norm()));
    EXPECT_LE((prediction->Hv - J.template leftCols<3>()).norm(), 1e-12 * J.norm())
        << pose.transpose() << " sees " << landmark.transpose();
    EXPECT_LE((prediction->Hl - J.template rightCols<size>()).norm(), 1e-12 * J.norm())
        << pose.transpose() << " sees " << landmark.transpose();
    EXPECT_TRUE(prediction->Hl.allFinite());
  });
  EXPECT_GE(tried, 200);
}

TYPED_TEST(PlanarMeasurementLaws, BearingsAreWrapped) {
  this->at_nasty_places([&](const Vector3d& pose, const auto& landmark) {
    const auto prediction = TypeParam::predict_measurement(pose, landmark);
    if (!prediction) return;
    EXPECT_LE(std::abs(prediction->z[prediction->z.size() - 1]), std::numbers::pi);
  });
}

TYPED_TEST(PlanarMeasurementLaws, NonFiniteStatesAreUndefined) {
  this->at_nasty_places([&](const Vector3d& pose, auto landmark) {
    landmark[1] = NAN;
    EXPECT_FALSE(TypeParam::predict_measurement(pose, landmark));
  });
}

}  // namespace
}  // namespace incognita
