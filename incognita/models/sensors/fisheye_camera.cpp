#include "incognita/models/sensors/fisheye_camera.hpp"

#include <algorithm>
#include <cmath>

#include "incognita/models/sensors/check_image.hpp"

namespace incognita {

bool FisheyeCamera::defined(const Eigen::Vector3d& point) const {
  if (!(point.z() > 1e-9)) return false;
  const double theta = std::atan2(point.head<2>().norm(), point.z());
  return theta <= largest_angle && rises_up_to(theta * theta);
}

Projection FisheyeCamera::project(const Eigen::Vector3d& point) const {
  const double iz = 1 / point.z();
  const Eigen::Vector2d c = point.head<2>() * iz;
  Eigen::Matrix<double, 2, 3> flat;  // d(c)/d(point)
  flat << iz, 0, -c.x() * iz, 0, iz, -c.y() * iz;
  const double s = c.squaredNorm(), ratio = distortion_ratio<double>(s);
  const Eigen::Matrix2d J = ratio * Eigen::Matrix2d::Identity() + 2 * ratio_slope(s) * c * c.transpose();
  return {Eigen::Vector2d(u0 + fu * c.x() * ratio, v0 + fv * c.y() * ratio),
          Eigen::Vector2d(fu, fv).asDiagonal() * J * flat};
}

std::optional<Eigen::Vector3d> FisheyeCamera::unproject(const Eigen::Vector2d& pixel) const {
  const Eigen::Vector2d d((pixel.x() - u0) / fu, (pixel.y() - v0) / fv);
  const double wanted = d.norm();
  double low = 0, high = end_of_rise();
  if (!(wanted <= distorted(high))) return std::nullopt;
  double theta = std::min(wanted, high);
  constexpr int max_steps = 100;  // of which a few suffice, but for a derivative near 0
  for (int i = 0; i < max_steps && low < high; ++i) {
    const double excess = distorted(theta) - wanted;
    (excess > 0 ? high : low) = theta;
    const double next = theta - excess / slope(theta * theta);
    const double inside = next >= low && next <= high ? next : 0.5 * (low + high);
    const double step = inside - theta;
    theta = inside;
    if (std::abs(step) <= 1e-15 * (1 + theta)) break;  // a few units of rounding
  }
  const double scale = wanted < 1e-9 ? 1 : std::tan(theta) / wanted;
  return Eigen::Vector3d(d.x() * scale, d.y() * scale, 1);
}

void FisheyeCamera::check() const {
  check_image(*this);
  need(std::isfinite(k1), "camera k1 must be finite", k1);
  need(std::isfinite(k2), "camera k2 must be finite", k2);
  need(std::isfinite(k3), "camera k3 must be finite", k3);
  need(std::isfinite(k4), "camera k4 must be finite", k4);
}

double FisheyeCamera::ratio_slope(double s) const {
  if (s < near_axis) return k1 - 1.0 / 3 + 2 * s * (0.2 - k1 + k2);
  const double theta = std::atan(std::sqrt(s));
  return (slope(theta * theta) / (1 + s) - distortion_ratio<double>(s)) / (2 * s);
}

bool FisheyeCamera::rises_up_to(double t) const {
  // b_i = sum_j C(i, j) / C(4, j) a_j, for the powers a_j on [0, 1]
  const double a1 = 3 * k1 * t, a2 = 5 * k2 * t * t, a3 = 7 * k3 * t * t * t, a4 = 9 * k4 * t * t * t * t;
  return is_positive(
      {1, 1 + a1 / 4, 1 + a1 / 2 + a2 / 6, 1 + 3 * a1 / 4 + a2 / 2 + a3 / 4, 1 + a1 + a2 + a3 + a4}, 0);
}

bool FisheyeCamera::is_positive(const Bernstein& b, int halvings) {
  constexpr int most_halvings = 30;
  if (!(b.front() > 0 && b.back() > 0)) return false;
  if (std::all_of(b.begin(), b.end(), [](double c) { return c > 0; })) return true;
  if (halvings == most_halvings) return false;
  Bernstein low = b, high = b;  // de Casteljau
  for (int level = 1; level < 5; ++level) {
    for (int i = 4; i >= level; --i) low[i] = 0.5 * (low[i] + low[i - 1]);
    for (int i = 0; i < 5 - level; ++i) high[i] = 0.5 * (high[i] + high[i + 1]);
  }
  return is_positive(low, halvings + 1) && is_positive(high, halvings + 1);
}

double FisheyeCamera::end_of_rise() const {
  if (rises_up_to(largest_angle * largest_angle)) return largest_angle;
  double low = 0, high = largest_angle;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (rises_up_to(middle * middle) ? low : high) = middle;
  }
  return low;
}

}  // namespace incognita
