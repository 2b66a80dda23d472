#include "experiments/example_5_4_run.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "incognita/control/track_reference.hpp"
#include "incognita/math/random.hpp"
#include "incognita/models/motion/heading.hpp"
#include "incognita/models/sensors/wide_angle_camera.hpp"
#include "incognita/slam/estimator/slam_estimator.hpp"
#include "incognita/world/fixed_rate_clock.hpp"
#include "incognita/world/points/point_world.hpp"

namespace incognita::swinging_camera {
namespace {

using Eigen::Vector3d;
using State = FreeCameraMotion::State<double>;

const Vector3d half_room_m(4, 3, 1);

SmallVector six(double first, double last) {
  SmallVector v(6);
  v << first, first, first, last, last, last;
  return v;
}

SmallVector most_of(const ControlSettings& s) {
  return six(s.max_acceleration_m_s2, s.max_angular_acceleration_rad_s2);
}

/// (5.29) as it stands there, or changed in part: no law that make_steering() takes.
struct OtherLaw final : Steering {
  Setup setup;
  explicit OtherLaw(const Setup& s) : setup(s) { setup.control.gain_orientation_per_s2 = 0; }
  SmallVector act(const SmallVector& x, double t) const override {
    const ControlSettings& gains = setup.control;
    const Reference r = at(setup.path, t);
    const Vector3d rate(0, -r.heading_rate, 0), acceleration(0, -r.heading_acceleration, 0);
    if (setup.law == Law::rate_alone)
      return track_reference(x, r.position, r.velocity, r.acceleration, level_gaze(r.heading), rate, gains,
                             acceleration);
    const Vector3d from = setup.law == Law::velocity_mended ? r.velocity : r.position;
    SmallVector u(6);
    u.head<3>() = -gains.gain_velocity_per_s * (x.segment<3>(7) - from) -
                  gains.gain_position_per_s2 * (x.head<3>() - r.position);
    u.tail<3>() = acceleration - gains.gain_rate_per_s * (x.tail<3>() - rate);
    return u.cwiseMax(-most_of(gains)).cwiseMin(most_of(gains));
  }
};

PointLandmarks room_of(int points, std::uint64_t seed) {
  RandomStream random(seed, "room");
  PointLandmarks place;
  for (int i = 0; i < points; ++i) {
    Vector3d point;
    for (int k = 0; k < 3; ++k) point[k] = random.uniform(-half_room_m[k], half_room_m[k]);
    place[i] = point;
  }
  return place;
}

SmallVector start_sigmas(const Setup& s) {
  SmallVector sigmas(FreeCameraMotion::error_size);
  sigmas << six(s.sigma_start_position_m, s.sigma_start_angle_rad),
      six(s.sigma_start_velocity_m_s, s.sigma_start_rate_rad_s);
  return sigmas;
}

SmallVector disturbances(const Setup& s) {
  return six(s.sigma_acceleration_m_s2, s.sigma_angular_acceleration_rad_s2);
}

SimulatedVehicle body_of(const Setup& s) {
  const SmallVector most = most_of(s.control);
  const PlantSettings plant{start_of(s), s.noise_times * start_sigmas(s), s.noise_times * disturbances(s),
                            -most, most};
  return {{FreeCameraMotion{}, plant, {}},
          {CameraSensor{lens()}, SmallVector::Constant(2, s.noise_times * s.sigma_pixel_px)}};
}

EstimatorSettings filter_of(const Setup& s, const PointLandmarks& place) {
  BodyModel member =
      body_with_sensor(FreeCameraMotion{}, CameraSensor{lens()}, start_of(s), start_sigmas(s), {}, {});
  member.input_sigmas =
      s.given_commands ? disturbances(s) : six(s.sigma_unknown_input, s.sigma_unknown_input);
  member.sensors[0].sigmas = SmallVector::Constant(2, s.sigma_pixel_px);
  EstimatorSettings settings;
  settings.bodies = {member};
  MapperSettings& filter = settings.filter;
  filter.inverse_depth_per_m = filter.sigma_inverse_depth_per_m = s.inverse_depth_per_m;
  filter.gate_probability = s.gate_probability;
  for (int i = 0; i < s.anchors; ++i) settings.anchors[i] = place.at(i);
  return settings;
}

/// The estimate of the camera compared with the truth.
void compare(const Estimate& e, Instant& at) {
  const BlockId camera = e.bodies.front().block;
  at.mean = e.belief.mean(camera);
  Eigen::Matrix<double, 12, 1> error;
  FreeCameraMotion::chart.minus({at.truth.data(), 13}, {at.mean.data(), 13}, {error.data(), 12});
  const Eigen::Matrix<double, 6, 6> P = e.belief.covariance(camera).topLeftCorner<6, 6>();
  at.error = error.head<6>();
  at.sigma = P.diagonal().cwiseSqrt();
  at.pose_nees = at.error.dot(P.ldlt().solve(at.error)) / 6;
  at.nis = e.last.update.rows > 0 ? e.last.update.nis / e.last.update.rows : 0;
  at.lost = e.status.state == TrackingState::lost;
}

std::vector<MappedPoint> map_of(const Estimate& e, const PointLandmarks& place) {
  std::vector<MappedPoint> map;
  for (const auto& [identity, landmark] : e.landmarks) {
    if (landmark.fixed) continue;
    const auto point = position_of(landmark.form, e.belief.mean(landmark.block));
    if (!point) continue;
    const Eigen::MatrixXd P = point->J * e.belief.covariance(landmark.block) * point->J.transpose();
    map.push_back({Vector3d(point->position), Vector3d(place.at(identity)), Eigen::Matrix3d(P)});
  }
  return map;
}

}  // namespace

std::unique_ptr<Steering> law_of(const Setup& s) {
  if (s.law != Law::corrected) return std::make_unique<OtherLaw>(s);
  SteeringSettings steering;
  steering.law = ControlLaw::feedback_linearization;
  steering.path = s.path;
  steering.camera = s.control;
  steering.most_input = most_of(s.control);
  return make_steering(FreeCameraMotion{}, steering, 1 / s.rate_hz);
}

State start_of(const Setup& s) {
  const Reference first = at(s.path, 0);
  State start = State::Zero();
  free_camera::position(start) = first.position;
  free_camera::orientation(start) = level_gaze(first.heading);
  if (s.starts_at_rest) return start;
  free_camera::velocity(start) = first.velocity;
  free_camera::angular_rate(start) << 0, -first.heading_rate, 0;
  return start;
}

Camera lens() {
  WideAngleCamera davison;
  davison.u0 = 162, davison.v0 = 125, davison.kd1 = 9e-6;
  return davison;
}

double angle_between_rad(const Eigen::Vector4d& a, const Eigen::Vector4d& b) {
  return quaternion_log(quaternion_product<double>(quaternion_conjugate(a), b)).norm();
}

double gaze_off_rad(const State& camera, const Reference& reference) {
  return angle_between_rad(level_gaze(reference.heading), free_camera::orientation(camera));
}

Course run(const Setup& s, std::uint64_t seed) {
  const PointLandmarks place = room_of(s.points, seed);
  SimulatedWorld world = point_world({body_of(s)}, seed);
  SensorSet sensors = point_sensors({body_of(s)}, {place}, seed);
  SlamEstimator estimator(filter_of(s, place));
  const auto law = law_of(s);
  FixedRateClock clock(s.rate_hz, s.duration_s);
  Estimate estimate;
  Command command;
  Course course;
  while (const Tick tick = clock.next()) {
    const auto truth = world.move(command, tick);
    Observation observation = sensors.measure(truth, tick);
    if (!s.given_commands && observation.bodies.front().input) observation.bodies.front().input->setZero();
    estimator.update(estimate, command, observation, tick);
    Instant now;
    now.t = tick.t;
    now.reference = at(s.path, tick.t);
    now.truth = truth->bodies.front().state;
    compare(estimate, now);
    now.command = law->act(s.steered_by_truth ? now.truth : now.mean, tick.t);
    command.bodies = {BodyCommand{now.command}};
    course.instants.push_back(now);
  }
  course.map = map_of(estimate, place);
  for (const auto& [identity, point] : place) course.place.emplace_back(point);
  return course;
}

}  // namespace incognita::swinging_camera
