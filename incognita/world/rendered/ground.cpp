#include "incognita/world/rendered/ground.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>

namespace incognita {
namespace {

constexpr double finest_m = 0.015;   // waves of a metre and 10 cm high are met to 0.1 mm
constexpr double most_cells = 1500;  // along a side; larger rooms get a coarser grid
constexpr double headroom_m = 0.5;   // left under the ceiling

void check(const Terrain& terrain, const Box& inside) {
  for (const double x : {inside.min.x(), inside.max.x()})
    for (const double y : {inside.min.y(), inside.max.y()})
      if (!terrain.contains(x, y))
        throw std::invalid_argument(
            "the terrain must reach all over the floor of the room, and does not reach (" +
            std::to_string(x) + ", " + std::to_string(y) + ")");
}

std::invalid_argument too_high(float highest_m) {
  std::ostringstream why;
  why << "the terrain rises to " << highest_m << " m, and must stay " << headroom_m
      << " m under the ceiling: make it lower ([terrain]), or the room higher (room.size_m)";
  return std::invalid_argument(why.str());
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

/// So far above the ground, and the ground no steeper than its steepest, a ray can go on for `gap` over how
/// fast the two can close in without passing a crest. Near the ground its own slope tells more; what is then
/// overshot is taken back along the chord.
float Ground::meet(const std::array<float, 3>& eye, const std::array<float, 3>& d, float most) const {
  constexpr int most_steps = 80;
  constexpr float near_m = 0.02f, touch_m = 2e-4f;
  const float level = std::sqrt(d[0] * d[0] + d[1] * d[1]);
  const float fastest = steepest_ * level - d[2];  // the gap closes by so much per unit of the parameter
  if (!(fastest > 0)) return most;                 // it climbs away from any ground
  const auto high = static_cast<float>(highest_m_);
  float t = eye[2] > high ? (high - eye[2]) / d[2] : 0.0f;
  if (!(t >= 0)) return most;  // level or upwards above all ground
  float t_above = t, gap_above = 0;
  for (int i = 0; i < most_steps && t < most; ++i) {
    const HeightAndSlope ground = at(eye[0] + t * d[0], eye[1] + t * d[1]);
    const float gap = eye[2] + t * d[2] - ground.height;
    if (gap < -touch_m && gap_above > 0) {
      t = t_above + (t - t_above) * gap_above / (gap_above - gap);
      gap_above *= 0.5f;  // Illinois: else one end may stay for ever
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
