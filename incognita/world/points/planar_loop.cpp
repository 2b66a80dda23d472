#include "incognita/world/points/planar_loop.hpp"

#include <cmath>
#include <numbers>

#include "incognita/math/random.hpp"
#include "incognita/models/motion/arc_motion.hpp"
#include "incognita/models/sensors/range_bearing.hpp"

namespace incognita {
namespace {

std::vector<RangeRecording::Landmark> landmarks_around(const PlanarLoopSettings& s) {
  const double radius = s.speed_m_s / s.turn_rate_rad_s;
  std::vector<RangeRecording::Landmark> landmarks;
  for (int i = 0; i < s.landmarks; ++i) {
    const double angle = 2 * std::numbers::pi * (i + 0.5) / s.landmarks;
    const double r = radius + (i % 2 ? s.landmark_offset_m : -s.landmark_offset_m);
    landmarks.push_back({i, Eigen::Vector2d(r * std::cos(angle), radius + r * std::sin(angle))});
  }
  return landmarks;
}

/// Noise is drawn for every landmark, measured or not. Otherwise two drives that differ by a millimeter would
/// get different noise from the first scan on in which a landmark is in range of only one of them.
RangeRecording::Scan scan_from(const planar::Pose<double>& pose, double t, const RangeRecording& r,
                               const PlanarLoopSettings& s, RandomStream& noise) {
  RangeRecording::Scan scan{t, {}};
  for (const RangeRecording::Landmark& landmark : r.landmarks) {
    const double range_noise = s.sigma_range_m * noise.normal();
    const double bearing_noise = s.sigma_bearing_rad * noise.normal();
    const auto prediction = RangeBearing::predict_measurement(pose, landmark.position);
    if (!prediction || prediction->z[0] > s.max_range_m) continue;
    scan.detections.push_back(
        {prediction->z[0] + range_noise, wrap_angle(prediction->z[1] + bearing_noise), landmark.identity});
  }
  return scan;
}

}  // namespace

RangeRecording drive_planar_loop(const PlanarLoopSettings& s, std::uint64_t seed) {
  RandomStream motion_noise(seed, "planar loop: motion"), scan_noise(seed, "planar loop: scans"),
      fix_noise(seed, "planar loop: fixes");
  RangeRecording r;
  r.format = "simulated";
  r.vehicle = "differential-drive";
  r.landmarks = landmarks_around(s);
  const ArcMotion<DifferentialDrive> plant{};
  const double dt = 1 / s.odometry_hz;
  const auto steps = static_cast<std::int64_t>(std::llround(s.duration_s * s.odometry_hz));
  const auto steps_per_scan = static_cast<std::int64_t>(std::llround(s.odometry_hz / s.scan_hz));
  const Eigen::Vector2d command(s.speed_m_s, s.turn_rate_rad_s);
  planar::Pose<double> pose(0, 0, 0);
  for (std::int64_t k = 0; k <= steps; ++k) {
    const double t = static_cast<double>(k) * dt;
    r.truth.push_back({t, pose.head<2>(), pose[2]});
    if (k % steps_per_scan == 0) {
      r.scans.push_back(scan_from(pose, t, r, s, scan_noise));
      const Eigen::Vector2d off(fix_noise.normal(), fix_noise.normal());
      r.fixes.push_back({t, pose.head<2>() + s.sigma_fix_m * off, std::nullopt});
    }
    r.odometry.push_back({t, command});
    const Eigen::Vector2d noise(s.sigma_speed_m_s * motion_noise.normal(),
                                s.sigma_turn_rate_rad_s * motion_noise.normal());
    pose = plant.f<double>(pose, command + noise, dt);
  }
  return r;
}

}  // namespace incognita
