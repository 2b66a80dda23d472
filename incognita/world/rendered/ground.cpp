#include "incognita/world/rendered/ground.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>

#include "incognita/messages/unfit_setting.hpp"

namespace incognita {
namespace {

constexpr double finest_m = 0.015;   // intersects waves of 1 m length and 10 cm height within 0.1 mm
constexpr double most_cells = 1500;  // per side; larger rooms get a coarser grid
constexpr double headroom_m = 0.5;   // clearance under the ceiling

std::string place(double x, double y) {
  std::ostringstream text;
  text << "[" << x << ", " << y << "]";
  return text.str();
}

void check(const Terrain& terrain, const Box& inside) {
  for (const double x : {inside.min.x(), inside.max.x()})
    for (const double y : {inside.min.y(), inside.max.y()})
      if (!terrain.contains(x, y))
        throw UnfitSetting({"terrain.size_m", "terrain.file", "room.size_m"},
                           "the terrain must cover the floor of the room, and does not reach " + place(x, y));
}

UnfitSetting too_high(float highest_m) {
  std::ostringstream why;
  why << "the terrain rises to " << highest_m << " m, and must stay " << headroom_m
      << " m under the ceiling: make it lower ([terrain]), or the room higher (room.size_m)";
  return {{"terrain.amplitude_m", "terrain.height_m", "terrain.slope_x", "terrain.slope_y", "room.size_m"},
          why.str()};
}

}  // namespace

Ground::Ground(const Terrain& terrain, const Box& inside) {
  check(terrain, inside);
  const Eigen::Vector3d size = inside.max - inside.min;
  const double cell_m = std::max(finest_m, std::max(size.x(), size.y()) / most_cells);
  const int rows = static_cast<int>(std::ceil(size.y() / cell_m)) + 1;
  columns_ = static_cast<int>(std::ceil(size.x() / cell_m)) + 1;
  x0_m_ = static_cast<float>(inside.min.x());
  y0_m_ = static_cast<float>(inside.min.y());
  per_m_ = static_cast<float>(1 / cell_m);
  last_x_ = std::nextafter(static_cast<float>(columns_ - 1), 0.0f);
  last_y_ = std::nextafter(static_cast<float>(rows - 1), 0.0f);
  heights_m_.reserve(static_cast<std::size_t>(columns_) * rows);
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns_; ++i)
      heights_m_.push_back(static_cast<float>(
          terrain.at<double>(inside.min.x() + i * cell_m, inside.min.y() + j * cell_m).height));
  const auto [low, high] = std::minmax_element(heights_m_.begin(), heights_m_.end());
  lowest_m_ = *low;
  highest_m_ = *high;
  if (highest_m_ > inside.max.z() - headroom_m) throw too_high(highest_m_);
  for (int j = 0; j + 1 < rows; ++j)
    for (int i = 0; i + 1 < columns_; ++i) {
      const float* h = &heights_m_[static_cast<std::size_t>(j) * columns_ + i];
      const float up_x = std::max(std::abs(h[1] - h[0]), std::abs(h[columns_ + 1] - h[columns_]));
      const float up_y = std::max(std::abs(h[columns_] - h[0]), std::abs(h[columns_ + 1] - h[1]));
      steepest_ = std::max(steepest_, std::hypot(up_x, up_y) * per_m_);
    }
}

/// Sphere tracing: with the gap to the ground and the maximum slope known, a ray can safely advance by `gap`
/// over the maximum closing rate. Near the ground the local slope gives a larger step; an overshoot is
/// corrected by the secant method.
float Ground::meet(const std::array<float, 3>& eye, const std::array<float, 3>& d, float most) const {
  constexpr int most_steps = 80;
  constexpr float near_m = 0.02f, touch_m = 2e-4f;
  const float level = std::sqrt(d[0] * d[0] + d[1] * d[1]);
  // Maximum closing rate of the gap per unit of ray parameter
  const float fastest = steepest_ * level - d[2];
  if (!(fastest > 0)) return most;  // climbs faster than any slope
  const auto high = static_cast<float>(highest_m_);
  float t = eye[2] > high ? (high - eye[2]) / d[2] : 0.0f;
  if (!(t >= 0)) return most;  // level or upwards above all ground
  float t_above = t, gap_above = 0;
  for (int i = 0; i < most_steps && t < most; ++i) {
    const HeightAndSlope ground = at(eye[0] + t * d[0], eye[1] + t * d[1]);
    const float gap = eye[2] + t * d[2] - ground.height;
    if (gap < -touch_m && gap_above > 0) {
      t = t_above + (t - t_above) * gap_above / (gap_above - gap);
      gap_above *= 0.5f;  // Illinois method: else one end may remain fixed
      continue;
    }
    const float closing = ground.slope_x * d[0] + ground.slope_y * d[1] - d[2];
    if (gap <= touch_m) return std::min(closing > 0.1f * fastest ? t + gap / closing : t, most);
    t_above = t;
    gap_above = gap;
    const float safe = gap / fastest;
    const bool straight = gap < near_m && closing > 0.1f * fastest;
    t += straight ? std::max(safe, gap / closing) : safe;
  }
  return t < most ? t : most;
}

}  // namespace incognita
