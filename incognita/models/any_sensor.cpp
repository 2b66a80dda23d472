#include "incognita/models/any_sensor.hpp"

#include <stdexcept>

namespace incognita {
namespace {

MountedPose camera_pose_on(const Mount& mount, const AnyMotion& motion, const SmallVector& vehicle) {
  return std::visit(
      [&](const auto& model) -> MountedPose {
        using Model = std::decay_t<decltype(model)>;
        const typename Model::template State<double> x = vehicle;
        if constexpr (Model::space == Space::line) {
          throw std::logic_error("a camera on a line");
        } else if constexpr (Model::space == Space::space) {
          MountedPose pose{CameraState::Zero(), SmallMatrix::Identity(6, Model::error_size)};
          pose.camera.head<7>() = x.template head<7>();
          return pose;
        } else {
          const MountedCamera<Model::error_size> mounted = mount.on(model.pose(x));
          return {mounted.camera, mounted.J};
        }
      },
      motion);
}

/// The pose the sensor measures from. On a line and on a plane it is the first part of the state.
template <class Sensor>
typename Sensor::Pose sensor_pose(const Sensor& sensor, const AnyMotion& motion, const SmallVector& vehicle) {
  if constexpr (std::is_same_v<typename Sensor::Pose, MountedPose>)
    return camera_pose_on(sensor.mount, motion, vehicle);
  else
    return vehicle.head(Sensor::Pose::RowsAtCompileTime);
}

/// Extends a Jacobian with respect to the pose to the whole state, of which the pose is the first part.
void pad_columns(SmallMatrix& J, const AnyMotion& motion) {
  const Eigen::Index had = J.cols(), errors = chart_of(motion).tangent();
  if (had == errors) return;
  J.conservativeResize(Eigen::NoChange, errors);
  J.rightCols(errors - had).setZero();
}

}  // namespace

const SensorTraits& traits_of(const AnySensor& sensor) {
  return std::visit(
      [](const auto& s) -> const SensorTraits& { return sensor_traits<std::decay_t<decltype(s)>>; }, sensor);
}

std::string incompatibility(const AnyMotion& motion, const AnySensor& sensor) {
  return std::visit([&](const auto& s) -> std::string { return s.incompatibility(traits_of(motion)); },
                    sensor);
}

const Chart& chart_of(const AnySensor& sensor) {
  return std::visit([](const auto& s) -> const Chart& { return std::decay_t<decltype(s)>::chart; }, sensor);
}

int dimensions_of(const AnySensor& sensor) {
  return std::visit([](const auto& s) { return std::decay_t<decltype(s)>::dimensions; }, sensor);
}

bool measures_distance(const AnySensor& sensor) {
  return std::visit([](const auto& s) { return std::decay_t<decltype(s)>::measures_distance; }, sensor);
}

std::optional<AnyPrediction> predict_measurement(const AnySensor& sensor, const AnyMotion& motion,
                                                 const SmallVector& vehicle,
                                                 const LandmarkParametrization& form,
                                                 const SmallVector& landmark) {
  auto prediction = std::visit(
      [&](const auto& s) { return s.predict_measurement(sensor_pose(s, motion, vehicle), form, landmark); },
      sensor);
  if (prediction) pad_columns(prediction->Hv, motion);
  return prediction;
}

bool is_in_view(const AnySensor& sensor, const SensorLimits& sensor_limits, const AnyPrediction& prediction,
                double distance_m) {
  if (!prediction.in_view || !(distance_m <= sensor_limits.max_range_m)) return false;
  return std::visit([&](const auto& s) { return s.in_field_of_view(prediction, sensor_limits); }, sensor);
}

bool is_possible(const AnySensor& sensor, const SmallVector& z) {
  return std::visit([&](const auto& s) { return s.is_possible(z); }, sensor);
}

std::optional<AnyInitialization> initialize_landmark(const AnySensor& sensor, const AnyMotion& motion,
                                                     const SmallVector& vehicle, const SmallVector& z,
                                                     double inverse_depth) {
  auto initialization = std::visit(
      [&](const auto& s) { return s.initialize(sensor_pose(s, motion, vehicle), z, inverse_depth); }, sensor);
  if (initialization) pad_columns(initialization->Jv, motion);
  return initialization;
}

std::optional<AnyPoint> position_of(const LandmarkParametrization& form, const SmallVector& landmark) {
  if (form.kind == LandmarkParametrization::Kind::point)
    return AnyPoint{landmark, SmallMatrix::Identity(landmark.size(), landmark.size())};
  if (form.kind == LandmarkParametrization::Kind::ray) return std::nullopt;
  if (!(landmark[landmark.size() - 1] > 0)) return std::nullopt;
  if (landmark.size() == PlanarInverseDistance::size) {
    const auto point = PlanarInverseDistance::point(PlanarInverseDistance::State<double>(landmark));
    return AnyPoint{point.position, point.J};
  }
  const auto point = InverseDepthLandmark{form.initial_axes}.point(InverseDepthLandmark::State(landmark));
  return AnyPoint{point.position, point.J};
}

double linearity_index(const LandmarkParametrization& form, const SmallVector& landmark,
                       double inverse_depth_var, const SmallVector& vehicle_position) {
  if (form.kind == LandmarkParametrization::Kind::point) return 0;
  if (landmark.size() == PlanarInverseDistance::size)
    return PlanarInverseDistance::linearity_index(PlanarInverseDistance::State<double>(landmark),
                                                  inverse_depth_var, Eigen::Vector2d(vehicle_position));
  return InverseDepthLandmark{form.initial_axes}.linearity_index(
      InverseDepthLandmark::State(landmark), inverse_depth_var, Eigen::Vector3d(vehicle_position));
}

}  // namespace incognita
