#include "incognita/control/paths/reference_path.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

namespace incognita {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double pi = std::numbers::pi;
constexpr double endless = std::numeric_limits<double>::infinity();
constexpr double peak_over_mean = 15.0 / 8;  // speed of a minimum-jerk motion
constexpr double no_way_m = 1e-9;            // below it a direction is undefined

template <class... Cases>
struct Overloaded : Cases... {
  using Cases::operator()...;
};
template <class... Cases>
Overloaded(Cases...) -> Overloaded<Cases...>;

Reference on(const PointPath& path, double) {
  return {.position = path.position, .heading = path.heading_rad};
}

Reference on(const CirclePath& path, double t) {
  const double rate = path.rate_rad_s, moving = t < 0 ? 0 : rate;
  const double angle = path.phase_rad + rate * std::max(t, 0.0);
  const Vector3d out(std::cos(angle), std::sin(angle), 0), left(-out.y(), out.x(), 0);
  return {.position = path.center + path.radius_m * out,
          .velocity = path.radius_m * moving * left,
          .acceleration = -path.radius_m * moving * moving * out,
          .heading = angle + std::copysign(pi / 2, rate),
          .heading_rate = moving};
}

Reference on(const BackAndForthPath& path, double t) {
  const double s = std::max(t, 0.0), moving = t < 0 ? 0 : path.amplitude_rad;
  const double p = path.amplitude_rad * (std::sin(2 * s) - 2 * s / pi);
  const double rate = moving * (2 * std::cos(2 * s) - 2 / pi), acceleration = -4 * moving * std::sin(2 * s);
  const Vector3d out(-std::cos(p), std::sin(p), 0), along(std::sin(p), std::cos(p), 0);  // d(out)/dp
  return {.position = path.center + path.radius_m * out,
          .velocity = path.radius_m * rate * along,
          .acceleration = path.radius_m * (acceleration * along - rate * rate * out),
          .heading = -p,
          .heading_rate = -rate,
          .heading_acceleration = -acceleration};
}

double leg_s(const WayPointPath& path, std::size_t leg) {
  return peak_over_mean * (path.points[leg + 1] - path.points[leg]).norm() / path.speed_m_s;
}

Reference on(const WayPointPath& path, double t) {
  Reference reference{.position = path.points.front()};
  double heading = 0, start = 0;
  for (std::size_t leg = 0; leg + 1 < path.points.size(); ++leg) {
    const Vector3d& from = path.points[leg];
    const Vector3d& to = path.points[leg + 1];
    const Vector2d way = (to - from).head<2>();
    if (way.norm() > no_way_m) heading = std::atan2(way.y(), way.x());  // vertical legs keep it
    const double end = start + leg_s(path, leg);
    reference = minimum_jerk(from, to, start, end, t);
    if (t < end) break;
    start = end;
  }
  reference.heading = heading;
  return reference;
}

Reference on(const SampledPath& path, double t) {
  const PathSpan span = span_of(path);
  const PoseMotion motion = at(path.spline, t);
  Reference reference{.position = motion.pose.head<3>(), .heading = motion.pose[3]};
  if (t < span.start_s || t >= span.end_s) return reference;
  reference.velocity = motion.rate.head<3>();
  reference.acceleration = motion.acceleration.head<3>();
  reference.heading_rate = motion.rate[3];
  reference.heading_acceleration = motion.acceleration[3];
  return reference;
}

void expect(bool right, const char* what) {
  if (!right) throw std::invalid_argument(what);
}

void check_circle(const Vector3d& center, double radius) {
  expect(center.allFinite(), "the center of the path is not finite");
  expect(radius > 0 && std::isfinite(radius), "the radius of the path must be positive");
}

/// Shifts each heading by whole turns to within half a turn of its predecessor.
void unwrap(Eigen::Ref<Eigen::RowVectorXd> headings) {
  for (Eigen::Index i = 1; i < headings.size(); ++i)
    headings[i] = headings[i - 1] + wrap_angle(headings[i] - headings[i - 1]);
}

/// Directions of travel at the samples; at standstill, that of the previous sample.
Eigen::RowVectorXd directions(const PoseSpline& spline) {
  Eigen::RowVectorXd headings = Eigen::RowVectorXd::Zero(spline.t.size());
  bool known = false;
  for (Eigen::Index i = 0; i < spline.t.size(); ++i) {
    const Vector2d velocity = at(spline, spline.t[i]).rate.head<2>();
    const bool moves = velocity.norm() > no_way_m;
    headings[i] = moves ? std::atan2(velocity.y(), velocity.x()) : i > 0 ? headings[i - 1] : 0;
    // Initial standstill: first direction of travel
    if (moves && !known) headings.head(i).setConstant(headings[i]);
    known = known || moves;
  }
  return headings;
}

}  // namespace

SampledPath through(const PathSamples& samples) {
  const auto n = static_cast<Eigen::Index>(samples.position.size());
  if (!samples.heading.empty() && samples.heading.size() != samples.position.size()) {
    throw std::invalid_argument("the path has " + std::to_string(n) + " positions and " +
                                std::to_string(samples.heading.size()) + " headings");
  }
  const Eigen::VectorXd t =
      Eigen::Map<const Eigen::VectorXd>(samples.t.data(), static_cast<Eigen::Index>(samples.t.size()));
  Eigen::Matrix4Xd pose = Eigen::Matrix4Xd::Zero(4, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto at_i = static_cast<std::size_t>(i);
    pose.col(i).head<3>() = samples.position[at_i];
    if (!samples.heading.empty()) pose(3, i) = samples.heading[at_i];
  }
  if (samples.heading.empty()) pose.row(3) = directions(pose_spline(t, pose));
  Eigen::RowVectorXd headings = pose.row(3);
  unwrap(headings);
  pose.row(3) = headings;
  return {pose_spline(t, pose)};
}

void check(const Path& path) {
  std::visit(
      Overloaded{
          [](const PointPath& p) {
            expect(p.position.allFinite() && std::isfinite(p.heading_rad), "the point is not finite");
          },
          [](const CirclePath& p) {
            check_circle(p.center, p.radius_m);
            expect(p.rate_rad_s != 0 && std::isfinite(p.rate_rad_s), "the rate of the circle must not be 0");
            expect(std::isfinite(p.phase_rad), "the phase of the circle is not finite");
          },
          [](const BackAndForthPath& p) {
            check_circle(p.center, p.radius_m);
            expect(p.amplitude_rad != 0 && std::isfinite(p.amplitude_rad),
                   "the amplitude of the path must not be 0");
          },
          [](const WayPointPath& p) {
            expect(!p.points.empty(), "there are no way-points");
            for (const Vector3d& point : p.points) expect(point.allFinite(), "a way-point is not finite");
            expect(p.speed_m_s > 0 && std::isfinite(p.speed_m_s),
                   "the speed between way-points must be positive");
          },
          [](const SampledPath& p) { expect(p.spline.t.size() >= 2, "a sampled path is made by through()"); },
      },
      path);
}

Reference at(const Path& path, double t) {
  return std::visit([t](const auto& p) { return on(p, t); }, path);
}

PathSpan span_of(const Path& path) {
  return std::visit(Overloaded{
                        [](const WayPointPath& p) {
                          PathSpan span;
                          for (std::size_t leg = 0; leg + 1 < p.points.size(); ++leg)
                            span.end_s += leg_s(p, leg);
                          return span;
                        },
                        [](const SampledPath& p) {
                          return PathSpan{p.spline.t[0], p.spline.t[p.spline.t.size() - 1]};
                        },
                        [](const auto&) {
                          return PathSpan{0, endless};
                        },
                    },
                    path);
}

}  // namespace incognita
