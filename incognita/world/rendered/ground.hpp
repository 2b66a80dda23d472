// Uneven floor of a rendered room: terrain heights on a fine grid with bilinear interpolation, for ray
// casting. The renderer uses only the grid, so all views are consistent.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "incognita/models/motion/terrain.hpp"
#include "incognita/world/rendered/box.hpp"

namespace incognita {

class Ground {
 public:
  /// Samples the terrain within the walls of `inside`. Throws UnfitSetting if the terrain does not cover the
  /// floor or is too high for the room.
  Ground(const Terrain& terrain, const Box& inside);

  double lowest_m() const { return lowest_m_; }
  double highest_m() const { return highest_m_; }

  struct HeightAndSlope {
    float height = 0;                ///< m
    float slope_x = 0, slope_y = 0;  ///< m per m
  };
  /// Height and slope at a position, m; positions beyond the walls are clamped to them.
  HeightAndSlope at(float x, float y) const {
    const float along = std::clamp((x - x0_m_) * per_m_, 0.0f, last_x_);
    const float across = std::clamp((y - y0_m_) * per_m_, 0.0f, last_y_);
    const int i = static_cast<int>(along), j = static_cast<int>(across);
    const float a = along - static_cast<float>(i), b = across - static_cast<float>(j);
    const float *row = &heights_m_[static_cast<std::size_t>(j) * columns_ + i], *next = row + columns_;
    const float near = row[0] + a * (row[1] - row[0]), far = next[0] + a * (next[1] - next[0]);
    const float up_x = (1 - b) * (row[1] - row[0]) + b * (next[1] - next[0]);
    return {near + b * (far - near), up_x * per_m_, (far - near) * per_m_};
  }

  /// Parameter at which the ray from `eye`, which is above the ground, along `d` first meets the ground;
  /// `most` if it does not meet it before.
  float meet(const std::array<float, 3>& eye, const std::array<float, 3>& d, float most) const;

 private:
  int columns_ = 0;
  float x0_m_ = 0, y0_m_ = 0, per_m_ = 1, last_x_ = 0, last_y_ = 0;
  float steepest_ = 0;  ///< maximum slope, m per m
  double lowest_m_ = 0, highest_m_ = 0;
  std::vector<float> heights_m_;  ///< row by row along x
};

}  // namespace incognita
