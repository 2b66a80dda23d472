#include "incognita/world/motion_spline.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace incognita {
namespace {

using Eigen::Vector3d;

/// Rotation vector from pose a to pose b, in the axes of a.
Vector3d turn_between(const RigidPose& a, const RigidPose& b) {
  return quaternion_log<double>(
      quaternion_product<double>(quaternion_conjugate<double>(a.world_from_body), b.world_from_body));
}

Eigen::Vector4d turned(const Eigen::Vector4d& world_from_body, const Vector3d& turn) {
  return quaternion_product<double>(world_from_body, quaternion_exp<double>(turn)).normalized();
}

/// J_r(e)^-1 v (Sola et al. 2018, eq. 144): the rate of the rotation vector e of a body that turns with rate v.
Vector3d inverse_right_jacobian_times(const Vector3d& e, const Vector3d& v) {
  const double a = e.norm();
  const double k = a < 1e-4 ? 1.0 / 12 : 1 / (a * a) - (1 + std::cos(a)) / (2 * a * std::sin(a));
  return v + 0.5 * e.cross(v) + k * e.cross(e.cross(v));
}

/// Slope at the middle of three samples of the parabola through them, from the slopes before and after.
Vector3d middle_slope(const Vector3d& before, double dt_before, const Vector3d& after, double dt_after) {
  return (before * dt_after + after * dt_before) / (dt_before + dt_after);
}

/// Cubic with given values and slopes (per unit of s) at s = 0 and s = 1.
struct Cubic {
  Vector3d start, start_slope, end, end_slope;

  Vector3d value(double s) const {
    const double r = 1 - s;
    return r * r * ((1 + 2 * s) * start + s * start_slope) + s * s * ((1 + 2 * r) * end - r * end_slope);
  }
  Vector3d slope(double s) const {
    return 6 * s * (1 - s) * (end - start) + (1 - s) * (1 - 3 * s) * start_slope +
           s * (3 * s - 2) * end_slope;
  }
};

void check(const std::vector<TimedPose>& samples) {
  if (samples.size() < 2) throw std::invalid_argument("a motion needs two poses or more");
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const TimedPose& s = samples[k];
    if (!std::isfinite(s.t) || !s.pose.position.allFinite() || !s.pose.world_from_body.allFinite())
      throw std::invalid_argument("the poses of a motion must be finite; number " + std::to_string(k) +
                                  " is not");
    if (k > 0 && !(s.t > samples[k - 1].t))
      throw std::invalid_argument("the times of a motion must increase; " + std::to_string(s.t) +
                                  " s follows " + std::to_string(samples[k - 1].t) + " s");
  }
}

}  // namespace

RigidPose extrapolated(const MovingPose& now, double dt_s) {
  if (dt_s == 0) return now.pose;  // to the last bit
  return {now.pose.position + dt_s * now.velocity, turned(now.pose.world_from_body, dt_s * now.rate)};
}

MotionSpline::MotionSpline(std::vector<TimedPose> samples) : samples_(std::move(samples)) {
  check(samples_);
  const std::size_t count = samples_.size();
  std::vector<double> dt;  // of each interval, with its mean velocity and angular rate
  std::vector<Vector3d> velocity, rate;
  for (std::size_t k = 0; k + 1 < count; ++k) {
    const TimedPose &a = samples_[k], &b = samples_[k + 1];
    dt.push_back(b.t - a.t);
    velocity.emplace_back((b.pose.position - a.pose.position) / dt[k]);
    rate.emplace_back(turn_between(a.pose, b.pose) / dt[k]);
  }
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t before = k == 0 ? 0 : k - 1, after = std::min(k, count - 2);
    velocities_.push_back(middle_slope(velocity[before], dt[before], velocity[after], dt[after]));
    rates_.push_back(middle_slope(rate[before], dt[before], rate[after], dt[after]));
  }
}

MovingPose MotionSpline::at(double t) const {
  const auto beyond = [&](const MovingPose& end, double dt) {
    return MovingPose{extrapolated(end, dt), end.velocity, end.rate};
  };
  if (t <= first_s()) return beyond(sample(0), t - first_s());
  if (t >= last_s()) return beyond(sample(samples_.size() - 1), t - last_s());
  const auto next = std::upper_bound(samples_.begin(), samples_.end(), t,
                                     [](double at, const TimedPose& sample) { return at < sample.t; });
  return between(static_cast<std::size_t>(next - samples_.begin()) - 1, t);
}

MovingPose MotionSpline::between(std::size_t k, double t) const {
  const TimedPose &a = samples_[k], &b = samples_[k + 1];
  const double dt = b.t - a.t, s = (t - a.t) / dt;
  const Cubic position{a.pose.position, dt * velocities_[k], b.pose.position, dt * velocities_[k + 1]};
  const Vector3d whole = turn_between(a.pose, b.pose);
  const Cubic turn{Vector3d::Zero(), dt * rates_[k], whole,
                   inverse_right_jacobian_times(whole, dt * rates_[k + 1])};
  const Vector3d r = turn.value(s);
  return {{position.value(s), turned(a.pose.world_from_body, r)},
          position.slope(s) / dt,
          right_jacobian(r) * turn.slope(s) / dt};
}

}  // namespace incognita
