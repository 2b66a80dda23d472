#include "incognita/models/sensors/range_sensors.hpp"

namespace incognita {

std::string RelativePositionSensor::incompatibility(const MotionTraits& motion) {
  return motion.on_line() ? "" : "a relative-position sensor needs a vehicle on a line";
}

std::string incompatibility_of_scanner(const MotionTraits& motion) {
  switch (motion.space) {
    case Space::line:
      return std::string(line_needs_relative_position);
    case Space::plane:
      return "";
    case Space::uneven_ground:
      return "on uneven ground the scan plane tilts with the vehicle, so that its measurements are not in the plane of the map";
    case Space::space:
      return "a planar scanner cannot localize a body in space";
  }
  return "";
}

std::optional<AnyPrediction> RelativePositionSensor::predict_measurement(const Pose& pose,
                                                                         const LandmarkParametrization&,
                                                                         const SmallVector& landmark) const {
  const auto prediction = RelativePosition::predict_measurement(pose[0], landmark[0]);
  return AnyPrediction{prediction.z, prediction.Hv, prediction.Hl};
}

std::optional<AnyInitialization> RelativePositionSensor::initialize(const Pose& pose, const SmallVector& z,
                                                                    double) const {
  const auto initialized = RelativePosition::initialize(pose[0], z[0]);
  return AnyInitialization{{}, Chart::line(1), initialized.landmark, initialized.Jv, initialized.Jz, {}};
}

std::optional<AnyPrediction> RangeBearingSensor::predict_measurement(const Pose& pose,
                                                                     const LandmarkParametrization&,
                                                                     const SmallVector& landmark) const {
  const auto prediction = RangeBearing::predict_measurement(pose, Eigen::Vector2d(landmark));
  if (!prediction) return std::nullopt;
  return AnyPrediction{prediction->z, prediction->Hv, prediction->Hl};
}

std::optional<AnyInitialization> RangeBearingSensor::initialize(const Pose& pose, const SmallVector& z,
                                                                double) const {
  const auto initialized = RangeBearing::initialize(pose, Eigen::Vector2d(z));
  return AnyInitialization{
      {}, RangeBearing::landmark_chart, initialized.landmark, initialized.Jv, initialized.Jz, {}};
}

std::optional<AnyPrediction> BearingSensor::predict_measurement(const Pose& pose,
                                                                const LandmarkParametrization& form,
                                                                const SmallVector& landmark) const {
  const auto as_any = [](const auto& prediction) -> std::optional<AnyPrediction> {
    if (!prediction) return std::nullopt;
    return AnyPrediction{prediction->z, prediction->Hv, prediction->Hl};
  };
  if (form.kind == LandmarkParametrization::Kind::point)
    return as_any(Bearing::predict_measurement(pose, Eigen::Vector2d(landmark)));
  return as_any(
      PlanarInverseDistance::predict_measurement(pose, PlanarInverseDistance::State<double>(landmark)));
}

std::optional<AnyInitialization> BearingSensor::initialize(const Pose& pose, const SmallVector& z,
                                                           double inverse_depth) const {
  const auto initialized = PlanarInverseDistance::initialize(pose, z[0], inverse_depth);
  return AnyInitialization{{LandmarkParametrization::Kind::inverse_depth, {1, 0, 0, 0}},
                           PlanarInverseDistance::chart,
                           initialized.landmark,
                           initialized.Jv,
                           initialized.Jz.col(0),
                           initialized.Jz.col(1)};
}

}  // namespace incognita
