// Sensors of vehicles on a line and on a plane, which measure distance and direction of points.
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>

#include "incognita/models/bearing.hpp"
#include "incognita/models/monobot.hpp"
#include "incognita/models/range_bearing.hpp"
#include "incognita/models/sensor_model.hpp"

namespace incognita {

/// Why a sensor that scans a plane cannot be on a vehicle.
std::string incompatibility_of_scanner(const MotionTraits& motion);

/// Whether the last number of a measurement, a bearing, is within the field of view.
inline bool has_bearing_in_view(const AnyLook& prediction, const Reach& reach) {
  return std::abs(prediction.z[prediction.z.size() - 1]) <= reach.field_of_view_rad / 2;
}

/// How far along its line a vehicle has a point before it: thesis (3.6).
struct LineScanner {
  static constexpr std::string_view name = "relative-position", word = "range-bearing";
  static constexpr std::string_view summary = "position of a point on a line, relative to the vehicle";
  static constexpr int dimensions = 1;
  static constexpr std::array<Quantity, 1> measurement{{{"position", "m", "range"}}};
  static constexpr Chart chart = Chart::line(1);
  static constexpr bool measures_distance = true;
  static constexpr auto initial_form = LandmarkForm::Kind::point;
  using Pose = Eigen::Matrix<double, 1, 1>;

  static std::string incompatibility(const MotionTraits& motion);
  std::optional<AnyLook> predict_measurement(const Pose& pose, const LandmarkForm&,
                                             const SmallVector& landmark) const {
    const auto prediction = RelativePosition::look(pose[0], landmark[0]);
    return AnyLook{prediction.z, prediction.Hv, prediction.Hl};
  }
  std::optional<AnyBirth> initialize(const Pose& pose, const SmallVector& z, double) const {
    const auto born = RelativePosition::birth(pose[0], z[0]);
    return AnyBirth{{}, Chart::line(1), born.landmark, born.Jv, born.Jz, {}};
  }
  bool in_field_of_view(const AnyLook&, const Reach&) const { return true; }
  bool is_possible(const SmallVector&) const { return true; }
};

/// Range and bearing: thesis (3.19).
struct LaserScanner {
  static constexpr std::string_view name = "range-bearing", word = name;
  static constexpr std::string_view summary =
      "range and bearing of a point on a plane, as a laser scanner measures";
  static constexpr int dimensions = 2;
  static constexpr std::array<Quantity, 2> measurement{{{"range", "m"}, {"bearing", "rad"}}};
  static constexpr Chart chart = RangeBearing::chart;
  static constexpr bool measures_distance = true;
  static constexpr auto initial_form = LandmarkForm::Kind::point;
  using Pose = planar::Pose<double>;

  static std::string incompatibility(const MotionTraits& motion) {
    return incompatibility_of_scanner(motion);
  }
  std::optional<AnyLook> predict_measurement(const Pose& pose, const LandmarkForm&,
                                             const SmallVector& landmark) const {
    const auto prediction = RangeBearing::look(pose, Eigen::Vector2d(landmark));
    if (!prediction) return std::nullopt;
    return AnyLook{prediction->z, prediction->Hv, prediction->Hl};
  }
  std::optional<AnyBirth> initialize(const Pose& pose, const SmallVector& z, double) const {
    const auto born = RangeBearing::birth(pose, Eigen::Vector2d(z));
    return AnyBirth{{}, RangeBearing::landmark_chart, born.landmark, born.Jv, born.Jz, {}};
  }
  bool in_field_of_view(const AnyLook& prediction, const Reach& reach) const {
    return has_bearing_in_view(prediction, reach);
  }
  /// Noise can make a near range negative: a scanner gives no such thing.
  bool is_possible(const SmallVector& z) const { return z[0] > 0; }
};

/// The bearing alone.
struct DirectionFinder {
  static constexpr std::string_view name = "bearing", word = name;
  static constexpr std::string_view summary = "bearing of a point on a plane";
  static constexpr int dimensions = 2;
  static constexpr std::array<Quantity, 1> measurement{{{"bearing", "rad"}}};
  static constexpr Chart chart = Bearing::chart;
  static constexpr bool measures_distance = false;
  static constexpr auto initial_form = LandmarkForm::Kind::inverse_depth;
  using Pose = planar::Pose<double>;

  static std::string incompatibility(const MotionTraits& motion) {
    return incompatibility_of_scanner(motion);
  }
  std::optional<AnyLook> predict_measurement(const Pose& pose, const LandmarkForm& form,
                                             const SmallVector& landmark) const;
  std::optional<AnyBirth> initialize(const Pose& pose, const SmallVector& z, double inverse_depth) const;
  bool in_field_of_view(const AnyLook& prediction, const Reach& reach) const {
    return has_bearing_in_view(prediction, reach);
  }
  bool is_possible(const SmallVector&) const { return true; }
};

}  // namespace incognita
