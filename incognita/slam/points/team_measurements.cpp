#include "incognita/slam/points/team_measurements.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <span>

#include "incognita/models/planar_frame.hpp"

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

bool uses_first_estimates(const TeamSettings& s) { return s.filter.linearization == "first-estimate"; }

/// The observed point, with the belief block that it depends on.
struct Target {
  LandmarkParametrization form;
  SmallVector mean, first;
  std::optional<BlockId> block;  ///< none: an anchor in a world-frame map
  SmallMatrix by_block;          ///< d(mean) / d(error of the block)
};

/// An anchor is constant in a world-frame map; in a vehicle-frame map it depends on the pose of the world.
Target target_of_anchor(const TeamEstimate& e, const SmallVector& anchor) {
  if (!e.world) return {{}, anchor, anchor, std::nullopt, {}};
  const planar::FramedPoint here =
      planar::out_of_frame(planar::Pose<double>(e.belief.mean(*e.world)), Eigen::Vector2d(anchor));
  return {{}, here.point, here.point, *e.world, here.by_frame};
}

/// `dimensions`: of the points of the map.
std::optional<Target> target_of(const TeamEstimate& e, bool of_vehicle, std::int64_t identity, int dimensions,
                                const TeamSettings& settings) {
  if (of_vehicle) {
    const auto other = static_cast<std::size_t>(identity);
    const TeamVehicle& observed = e.vehicles.at(other);
    const AnyMotion& motion = settings.members[other].motion;
    const AnyPoint at = position_of(motion, e.belief.mean(observed.block), dimensions);
    return Target{
        {}, at.position, position_of(motion, observed.prediction, dimensions).position, observed.block, at.J};
  }
  const auto anchor = settings.anchors.find(identity);
  if (anchor != settings.anchors.end()) return target_of_anchor(e, anchor->second);
  const auto found = e.landmarks.find(identity);
  if (found == e.landmarks.end()) return std::nullopt;
  const TeamLandmark& landmark = found->second;
  const SmallVector mean = e.belief.mean(landmark.block);
  const int errors = e.belief.chart(landmark.block).tangent();
  return Target{landmark.form, mean, landmark.first, landmark.block, SmallMatrix::Identity(errors, errors)};
}

/// Whether two vehicles are so close, relative to the covariance of their relative position, that the
/// first-order model fails. The neglected term, the sigma of the predicted measurement times the relative
/// position's sigma over the distance, must not exceed the measurement noise.
bool too_near(const TeamEstimate& e, std::size_t viewer, std::size_t other, const SmallMatrix& Hl,
              const SmallMatrix& R, const TeamSettings& settings) {
  const int dimensions = dimensions_of(settings.members[viewer].sensor);
  const BlockId a = e.vehicles[viewer].block, b = e.vehicles[other].block;
  const AnyPoint from = position_of(settings.members[viewer].motion, e.belief.mean(a), dimensions);
  const AnyPoint to = position_of(settings.members[other].motion, e.belief.mean(b), dimensions);
  const SmallMatrix across = from.J * e.belief.covariance(a, b) * to.J.transpose();
  const SmallMatrix P = from.J * e.belief.covariance(a) * from.J.transpose() +
                        to.J * e.belief.covariance(b) * to.J.transpose() - across - across.transpose();
  const double squared_share = P.trace() / (to.position - from.position).squaredNorm();
  const SmallVector changes = (Hl * P * Hl.transpose()).diagonal();
  return ((changes * squared_share).array() > R.diagonal().array()).any();
}

}  // namespace

SmallMatrix detection_noise(const TeamMember& member, const SmallVector& z) {
  SmallVector sigmas = member.sigmas;
  sigmas[0] += member.sigma_range_ratio * std::abs(z[0]);
  return sigmas.cwiseAbs2().asDiagonal();
}

std::optional<LinearizedDetection> linearize_detection(const TeamEstimate& e, int vehicle, bool of_vehicle,
                                                       const PointDetection& detection,
                                                       const TeamSettings& settings) {
  const TeamVehicle& viewer = e.vehicles[static_cast<std::size_t>(vehicle)];
  const TeamMember& member = settings.members[static_cast<std::size_t>(vehicle)];
  const auto target = target_of(e, of_vehicle, detection.identity, dimensions_of(member.sensor), settings);
  if (!target) return std::nullopt;
  const auto prediction = predict_measurement(member.sensor, member.motion, e.belief.mean(viewer.block),
                                              target->form, target->mean);
  const auto derived =
      uses_first_estimates(settings)
          ? predict_measurement(member.sensor, member.motion, viewer.prediction, target->form, target->first)
          : prediction;
  if (!prediction || !derived) return std::nullopt;
  const SmallMatrix R = detection_noise(member, detection.z);
  if (of_vehicle && too_near(e, static_cast<std::size_t>(vehicle),
                             static_cast<std::size_t>(detection.identity), derived->Hl, R, settings))
    return std::nullopt;
  LinearizedDetection out;
  out.predicted = prediction->z;
  out.linearized.add(viewer.block, derived->Hv);
  if (target->block) out.linearized.add(*target->block, (derived->Hl * target->by_block).eval());
  out.linearized.residual = residual_of(member.sensor, detection.z, prediction->z);
  out.linearized.R = R;
  return out;
}

LinearizedMeasurement linearized_fix(const TeamEstimate& e, std::size_t vehicle, const Eigen::Vector2d& fix,
                                     const TeamSettings& settings) {
  const TeamMember& member = settings.members[vehicle];
  const BlockId block = e.vehicles[vehicle].block;
  LinearizedMeasurement measurement;
  if (e.world) {
    const planar::FramedPose observed = planar::in_frame(planar::Pose<double>(e.belief.mean(*e.world)),
                                                         planar::Pose<double>(e.belief.mean(block)));
    measurement.add(block, observed.by_pose.topRows<2>());
    measurement.add(*e.world, observed.by_frame.topRows<2>());
    measurement.residual = fix - observed.pose.head<2>();
  } else {
    const AnyPoint at = position_of(member.motion, e.belief.mean(block), 2);
    measurement.add(block, at.J);
    measurement.residual = fix - Eigen::Vector2d(at.position);
  }
  measurement.R = member.sigma_fix_m * member.sigma_fix_m * Eigen::Matrix2d::Identity();
  return measurement;
}

SmallVector anchor_position(const TeamEstimate& e, const SmallVector& anchor) {
  return target_of_anchor(e, anchor).mean;
}

bool is_usable(const AnySensor& sensor, const SmallVector& z) {
  return z.size() == chart_of(sensor).ambient() && z.allFinite() && is_possible(sensor, z);
}

std::optional<SmallVector> point_of(const TeamEstimate& e, int vehicle, const SmallVector& z,
                                    const TeamSettings& settings) {
  const TeamMember& member = settings.members[static_cast<std::size_t>(vehicle)];
  if (!is_usable(member.sensor, z) || !measures_distance(member.sensor)) return std::nullopt;
  const auto initialization = initialize_landmark(
      member.sensor, member.motion, e.belief.mean(e.vehicles[static_cast<std::size_t>(vehicle)].block), z,
      settings.filter.inverse_depth_per_m);
  if (!initialization) return std::nullopt;
  const auto at = position_of(initialization->form, initialization->landmark);
  return at ? std::optional(at->position) : std::nullopt;
}

void set_residual(LinearizedDetection& measurement, const TeamMember& member, const SmallVector& z) {
  measurement.linearized.residual = residual_of(member.sensor, z, measurement.predicted);
  measurement.linearized.R = detection_noise(member, z);
}

bool initialize_landmark(TeamEstimate& e, int vehicle, const PointDetection& detection,
                         const TeamSettings& settings) {
  const TeamVehicle& viewer = e.vehicles[static_cast<std::size_t>(vehicle)];
  const TeamMember& member = settings.members[static_cast<std::size_t>(vehicle)];
  if (!is_usable(member.sensor, detection.z)) return false;
  auto initialization = initialize_landmark(member.sensor, member.motion, e.belief.mean(viewer.block),
                                            detection.z, settings.filter.inverse_depth_per_m);
  if (!initialization) return false;
  if (uses_first_estimates(settings)) {  // Jacobians consistent with those of later measurements
    const auto prediction = predict_measurement(member.sensor, member.motion, viewer.prediction,
                                                initialization->form, initialization->landmark);
    if (!prediction) return false;
    initialization->Jz = Eigen::Matrix2d(prediction->Hl).inverse();
    initialization->Jv = -initialization->Jz * prediction->Hv;
  }
  SmallMatrix noise =
      initialization->Jz * detection_noise(member, detection.z) * initialization->Jz.transpose();
  if (initialization->Jd.size() > 0) {
    const double sigma = settings.filter.sigma_inverse_depth_per_m;
    noise += sigma * sigma * initialization->Jd * initialization->Jd.transpose();
  }
  // The initial position duplicates that of the vehicle: regularization keeps the covariance positive definite
  if (initialization->form.kind == LandmarkParametrization::Kind::inverse_depth)
    noise.diagonal().head(initialization->landmark.size() == 4 ? 2 : 3).array() += 1e-8;
  const BlockParent parent{viewer.block, initialization->Jv};
  TeamLandmark landmark{detection.identity, initialization->form, 0, initialization->landmark, 1};
  landmark.block = e.belief.augment(initialization->chart, initialization->landmark, {&parent, 1}, noise);
  e.landmarks.emplace(detection.identity, landmark);
  return true;
}

void convert_converged_inverse_depths(TeamEstimate& e, const TeamSettings& settings) {
  for (auto next = e.landmarks.begin(); next != e.landmarks.end();) {
    const auto at = next++;
    TeamLandmark& landmark = at->second;
    if (landmark.form.kind == LandmarkParametrization::Kind::point) continue;
    const SmallVector mean = e.belief.mean(landmark.block);
    const Eigen::Index last = mean.size() - 1;
    if (mean[last] < 0) {
      e.belief.drop(landmark.block);
      e.landmarks.erase(at);
      continue;
    }
    const double var = e.belief.covariance(landmark.block)(last, last);
    const int dimensions = dimensions_of(settings.members.front().sensor);  // equal for all members
    double index = 1e9;
    for (std::size_t i = 0; i < e.vehicles.size(); ++i)
      index = std::min(index, linearity_index(landmark.form, mean, var,
                                              position_of(settings.members[i].motion,
                                                          e.belief.mean(e.vehicles[i].block), dimensions)
                                                  .position));
    if (!(index < settings.filter.max_linearity_index)) continue;
    const auto point = position_of(landmark.form, mean);
    if (!point) continue;
    const auto size = point->position.size();
    e.belief.replace(landmark.block, Chart::line(static_cast<int>(size)), point->position, point->J,
                     BlockMatrix::Zero(size, size));
    landmark.form.kind = LandmarkParametrization::Kind::point;
    landmark.first = point->position;
  }
}

}  // namespace incognita
