#include "incognita/slam/mapper/measurements.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <span>

#include "incognita/models/motion/planar_frame.hpp"

namespace incognita {
namespace {

std::span<const double> numbers(const SmallVector& v) {
  return {v.data(), static_cast<std::size_t>(v.size())};
}

SmallVector residual_of(const AnySensor& sensor, const SmallVector& measured, const SmallVector& predicted) {
  SmallVector residual(measured.size());
  chart_of(sensor).minus(numbers(measured), numbers(predicted),
                         {residual.data(), static_cast<std::size_t>(residual.size())});
  return residual;
}

bool uses_first_estimates(const EstimatorSettings& s) {
  return s.filter.linearization == Linearization::first_estimate;
}

/// The observed point, with the belief block that it depends on.
struct Target {
  LandmarkParametrization form;
  SmallVector mean, first;
  std::optional<BlockId> block;  ///< none: an anchor in a world-frame map
  SmallMatrix by_block;          ///< d(mean) / d(error of the block)
};

/// An anchor is constant in a world-frame map; in a vehicle-frame map it depends on the pose of the world.
Target target_of_anchor(const Estimate& e, const SmallVector& anchor) {
  if (!e.world) return {{}, anchor, anchor, std::nullopt, {}};
  const planar::FramedPoint here =
      planar::out_of_frame(planar::Pose<double>(e.belief.mean(*e.world)), Eigen::Vector2d(anchor));
  return {{}, here.point, here.point, *e.world, here.by_frame};
}

/// Nothing for a landmark that the sensor does not measure, such as a feature of a camera.
std::optional<Target> target_of(const Estimate& e, bool of_body, std::int64_t id, const AnySensor& sensor,
                                const EstimatorSettings& settings) {
  const int dimensions = dimensions_of(sensor);
  if (of_body) {
    const auto other = static_cast<std::size_t>(id);
    const Body& observed = e.bodies.at(other);
    const AnyMotion& motion = settings.bodies[other].motion;
    const AnyPoint at = position_of(motion, e.belief.mean(observed.block), dimensions);
    return Target{
        {}, at.position, position_of(motion, observed.prediction, dimensions).position, observed.block, at.J};
  }
  const auto found = e.landmarks.find(id);
  if (found == e.landmarks.end()) return std::nullopt;
  const Landmark& landmark = found->second;
  if (!is_measurable(landmark, sensor)) return std::nullopt;
  if (landmark.fixed) return target_of_anchor(e, landmark.position);
  const SmallVector mean = e.belief.mean(landmark.block);
  const int errors = e.belief.chart(landmark.block).tangent();
  return Target{landmark.form, mean, landmark.first, landmark.block, SmallMatrix::Identity(errors, errors)};
}

/// Whether two bodies are so close, relative to the covariance of their relative position, that the
/// first-order model fails. The neglected term, the sigma of the predicted measurement times the relative
/// position's sigma over the distance, must not exceed the measurement noise.
bool too_near(const Estimate& e, std::size_t viewer, std::size_t other, int dimensions, const SmallMatrix& Hl,
              const SmallMatrix& R, const EstimatorSettings& settings) {
  const BlockId a = e.bodies[viewer].block, b = e.bodies[other].block;
  const AnyPoint from = position_of(settings.bodies[viewer].motion, e.belief.mean(a), dimensions);
  const AnyPoint to = position_of(settings.bodies[other].motion, e.belief.mean(b), dimensions);
  const SmallMatrix across = from.J * e.belief.covariance(a, b) * to.J.transpose();
  const SmallMatrix P = from.J * e.belief.covariance(a) * from.J.transpose() +
                        to.J * e.belief.covariance(b) * to.J.transpose() - across - across.transpose();
  const double squared_share = P.trace() / (to.position - from.position).squaredNorm();
  const SmallVector changes = (Hl * P * Hl.transpose()).diagonal();
  return ((changes * squared_share).array() > R.diagonal().array()).any();
}

/// See LinearizedDetection::is_linear. By differences of the prediction over a tenth of a sigma: farther away the landmark
/// may lie behind the sensor.
bool is_linear_in_depth(const Estimate& e, const PointSensor& sensor, const AnyMotion& motion,
                        const SmallVector& state, const Target& target, const SmallVector& predicted,
                        const SmallMatrix& R) {
  if (target.form.kind == LandmarkParametrization::Kind::point || !target.block) return true;
  constexpr double share = 0.1;
  const Eigen::Index depth = target.mean.size() - 1;
  const double step = share * std::sqrt(e.belief.covariance(*target.block)(depth, depth));
  const auto change = [&](double by) -> std::optional<SmallVector> {
    SmallVector moved = target.mean;
    moved[depth] += by;
    const auto there = predict_measurement(sensor.sensor, motion, state, target.form, moved);
    if (!there) return std::nullopt;
    return residual_of(sensor.sensor, there->z, predicted);
  };
  const auto nearer = change(step), farther = change(-step);
  if (!nearer || !farther) return false;
  const SmallVector second_order = (*nearer + *farther) / (2 * share * share);
  return (second_order.array().square() <= R.diagonal().array()).all();
}

}  // namespace

const PointSensor& sensor_of(const EstimatorSettings& settings, int body, int sensor) {
  return settings.bodies.at(static_cast<std::size_t>(body)).sensors.at(static_cast<std::size_t>(sensor));
}

SmallMatrix detection_noise(const PointSensor& sensor, const SmallVector& z) {
  SmallVector sigmas = sensor.sigmas;
  sigmas[0] += sensor.sigma_range_ratio * std::abs(z[0]);
  return sigmas.cwiseAbs2().asDiagonal();
}

bool is_measurable(const Landmark& landmark, const AnySensor& sensor) {
  if (landmark.camera >= 0 || landmark.form.kind == LandmarkParametrization::Kind::ray) return false;
  const int dimensions = dimensions_of(sensor);
  if (landmark.fixed) return landmark.position.size() == dimensions;
  const auto numbers = landmark.first.size();
  return landmark.form.kind == LandmarkParametrization::Kind::point ? numbers == dimensions
                                                                    : numbers == 2 * dimensions;
}

std::optional<SmallVector> predict_in_view(const Estimate& e, const Landmark& landmark, int body,
                                           int sensor_index, const EstimatorSettings& settings) {
  const AnyMotion& motion = settings.bodies[static_cast<std::size_t>(body)].motion;
  const PointSensor& sensor = sensor_of(settings, body, sensor_index);
  if (!is_measurable(landmark, sensor.sensor)) return std::nullopt;
  const SmallVector state = e.belief.mean(e.bodies[static_cast<std::size_t>(body)].block);
  const SmallVector mean =
      landmark.fixed ? anchor_position(e, landmark.position) : SmallVector(e.belief.mean(landmark.block));
  const auto at = position_of(landmark.form, mean);
  const auto prediction = predict_measurement(sensor.sensor, motion, state, landmark.form, mean);
  if (!prediction || !at) return std::nullopt;
  const SmallVector from = position_of(motion, state, dimensions_of(sensor.sensor)).position;
  const double distance_m = (at->position - from).norm();
  if (!is_in_view(sensor.sensor, sensor.limits, *prediction, distance_m)) return std::nullopt;
  return prediction->z;
}

std::optional<LinearizedDetection> linearize_detection(const Estimate& e, int body, bool of_body,
                                                       const PointDetection& detection,
                                                       const EstimatorSettings& settings) {
  const Body& viewer = e.bodies[static_cast<std::size_t>(body)];
  const AnyMotion& motion = settings.bodies[static_cast<std::size_t>(body)].motion;
  const PointSensor& sensor = sensor_of(settings, body, detection.sensor);
  const int dimensions = dimensions_of(sensor.sensor);
  const auto target = target_of(e, of_body, detection.identity, sensor.sensor, settings);
  if (!target) return std::nullopt;
  const auto prediction =
      predict_measurement(sensor.sensor, motion, e.belief.mean(viewer.block), target->form, target->mean);
  const auto derived =
      uses_first_estimates(settings)
          ? predict_measurement(sensor.sensor, motion, viewer.prediction, target->form, target->first)
          : prediction;
  if (!prediction || !derived) return std::nullopt;
  const SmallMatrix R = detection_noise(sensor, detection.z);
  if (of_body && too_near(e, static_cast<std::size_t>(body), static_cast<std::size_t>(detection.identity),
                          dimensions, derived->Hl, R, settings))
    return std::nullopt;
  LinearizedDetection out;
  out.predicted = prediction->z;
  out.linearized.add(viewer.block, derived->Hv);
  if (target->block) out.linearized.add(*target->block, (derived->Hl * target->by_block).eval());
  out.linearized.residual = residual_of(sensor.sensor, detection.z, prediction->z);
  out.linearized.R = R;
  out.is_linear =
      is_linear_in_depth(e, sensor, motion, e.belief.mean(viewer.block), *target, prediction->z, R);
  return out;
}

LinearizedMeasurement linearized_fix(const Estimate& e, std::size_t body, const Eigen::Vector2d& fix,
                                     const EstimatorSettings& settings) {
  const BodyModel& model = settings.bodies[body];
  const BlockId block = e.bodies[body].block;
  LinearizedMeasurement measurement;
  if (e.world) {
    const planar::FramedPose observed = planar::in_frame(planar::Pose<double>(e.belief.mean(*e.world)),
                                                         planar::Pose<double>(e.belief.mean(block)));
    measurement.add(block, observed.by_pose.topRows<2>());
    measurement.add(*e.world, observed.by_frame.topRows<2>());
    measurement.residual = fix - observed.pose.head<2>();
  } else {
    const AnyPoint at = position_of(model.motion, e.belief.mean(block), 2);
    measurement.add(block, at.J);
    measurement.residual = fix - Eigen::Vector2d(at.position);
  }
  measurement.R = model.sigma_fix_m * model.sigma_fix_m * Eigen::Matrix2d::Identity();
  return measurement;
}

SmallVector anchor_position(const Estimate& e, const SmallVector& anchor) {
  return target_of_anchor(e, anchor).mean;
}

bool is_usable(const AnySensor& sensor, const SmallVector& z) {
  return z.size() == chart_of(sensor).ambient() && z.allFinite() && is_possible(sensor, z);
}

std::optional<SmallVector> point_of(const Estimate& e, int body, const PointDetection& detection,
                                    const EstimatorSettings& settings) {
  const AnySensor& sensor = sensor_of(settings, body, detection.sensor).sensor;
  if (!is_usable(sensor, detection.z) || !measures_distance(sensor)) return std::nullopt;
  const auto index = static_cast<std::size_t>(body);
  const auto initialization =
      initialize_landmark(sensor, settings.bodies[index].motion, e.belief.mean(e.bodies[index].block),
                          detection.z, settings.filter.inverse_depth_per_m);
  if (!initialization) return std::nullopt;
  const auto at = position_of(initialization->form, initialization->landmark);
  return at ? std::optional(at->position) : std::nullopt;
}

void set_residual(LinearizedDetection& measurement, const PointSensor& sensor, const SmallVector& z) {
  measurement.linearized.residual = residual_of(sensor.sensor, z, measurement.predicted);
  measurement.linearized.R = detection_noise(sensor, z);
}

}  // namespace incognita
