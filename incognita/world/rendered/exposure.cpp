#include "incognita/world/rendered/exposure.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "incognita/world/rendered/render.hpp"
#include "incognita/world/rendered/room_ray.hpp"

namespace incognita {
namespace {

constexpr int most_images = 32;
constexpr double sharp_px = 0.5, px_per_image = 1.5;
constexpr int probes = 5;  // per axis, for the motion in the image

void need(bool ok, const char* what, double value) {
  if (!ok) throw std::invalid_argument(std::string(what) + ", got " + std::to_string(value));
}

bool is_duration(double s) { return s >= 0 && std::isfinite(s); }

}  // namespace

double row_time_s(double row, int rows, double readout_s) { return ((row + 0.5) / rows - 0.5) * readout_s; }

ExposedCamera::ExposedCamera(const Room& room, const Camera& camera, double duration_s, double readout_s)
    : room_(room), camera_(camera), rays_(camera), duration_s_(duration_s), readout_s_(readout_s) {
  need(is_duration(duration_s), "exposure duration_s must be zero or positive", duration_s);
  need(is_duration(readout_s), "exposure readout_s must be zero or positive", readout_s);
}

/// Largest displacement in the image, over a grid of pixels, of the points that the camera sees.
double ExposedCamera::motion_px(const RigidPose& before, const RigidPose& after) const {
  const Eigen::Matrix3d world_from_before = rotation_matrix<double>(before.world_from_body),
                        after_from_world = rotation_matrix<double>(after.world_from_body).transpose();
  double most = 0;
  for (int i = 0; i < probes; ++i)
    for (int k = 0; k < probes; ++k) {
      const Eigen::Vector2d pixel((rays_.width - 1.0) * i / (probes - 1),
                                  (rays_.height - 1.0) * k / (probes - 1));
      const auto ray = camera_.unproject(pixel);
      if (!ray) continue;
      const Eigen::Vector3d direction = world_from_before * *ray;
      const Eigen::Vector3d point =
          before.position + ray_length(room_.layout(), before.position, direction) * direction;
      if (const auto seen = camera_.project(after_from_world * (point - after.position)))
        most = std::max(most, (seen->pixel - pixel).norm());
    }
  return most;
}

int ExposedCamera::images(const PoseInTime& world_from_camera) const {
  if (duration_s_ == 0) return 1;
  const double px = motion_px(world_from_camera(-duration_s_ / 2), world_from_camera(duration_s_ / 2));
  if (px < sharp_px) return 1;
  return static_cast<int>(std::clamp(std::ceil(px / px_per_image), 2.0, double{most_images}));
}

void ExposedCamera::render_at(const PoseInTime& world_from_camera, double dt_s, Image& out) {
  rows_.clear();
  if (readout_s_ == 0) rows_.push_back(world_from_camera(dt_s));
  for (int v = 0; readout_s_ > 0 && v < rays_.height; ++v)
    rows_.push_back(world_from_camera(dt_s + row_time_s(v, rays_.height, readout_s_)));
  render(room_, rays_, rows_, out);
}

void ExposedCamera::expose(const PoseInTime& world_from_camera, Image& out) {
  const int count = images(world_from_camera);
  if (count == 1) return render_at(world_from_camera, 0, out);
  sums_.assign(static_cast<std::size_t>(rays_.width) * rays_.height, 0);
  for (int i = 0; i < count; ++i) {
    render_at(world_from_camera, ((i + 0.5) / count - 0.5) * duration_s_, out);
    const std::uint8_t* gray = out.row(0);
    for (std::size_t at = 0; at < sums_.size(); ++at)
      sums_[at] = static_cast<std::uint16_t>(sums_[at] + gray[at]);
  }
  std::uint8_t* gray = out.row(0);
  const float share = 1.0f / static_cast<float>(count);
  for (std::size_t at = 0; at < sums_.size(); ++at)
    gray[at] = static_cast<std::uint8_t>(static_cast<float>(sums_[at]) * share + 0.5f);
}

ExposureGain::ExposureGain(const ExposureSettings& settings, std::uint64_t seed, const std::string& name)
    : settings_(settings), random_(seed, name) {
  need(settings.step_ratio >= 1 && std::isfinite(settings.step_ratio),
       "exposure step_ratio must be 1 or more", settings.step_ratio);
  need(settings.step_interval_s > 0, "exposure step_interval_s must be positive", settings.step_interval_s);
  if (!std::ranges::is_sorted(settings.step_times_s))
    throw std::invalid_argument("exposure step_times_s must increase");
  next_s_ = next_time();
}

/// Time of the step after `next_s_`: given, or after an exponentially distributed interval.
double ExposureGain::next_time() {
  const std::vector<double>& given = settings_.step_times_s;
  if (settings_.step_ratio == 1) return std::numeric_limits<double>::infinity();
  if (given.empty()) return next_s_ - settings_.step_interval_s * std::log(1 - random_.uniform());
  return steps_ < given.size() ? given[steps_] : std::numeric_limits<double>::infinity();
}

/// Steps at given times go up and down in turn; others go to a random gain.
double ExposureGain::next_gain() {
  const double ratio = settings_.step_ratio;
  if (!settings_.step_times_s.empty()) return steps_ % 2 ? 1 : ratio;
  return std::pow(ratio, random_.uniform(-1, 1));
}

double ExposureGain::at(double t) {
  while (t >= next_s_) {
    gain_ = next_gain();
    ++steps_;
    next_s_ = next_time();
  }
  return gain_;
}

}  // namespace incognita
