// A target cut from a photograph of a flat rectangle: a poster, a book, a screen.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "incognita/io/targets/target_files.hpp"
#include "incognita/models/sensors/camera.hpp"

namespace incognita {

struct TargetCut {
  std::array<Eigen::Vector2d, 4> corners_px;  ///< in the photograph, clockwise from the upper left
  double width_m = 0, height_m = 0;           ///< between the corners
  std::optional<Camera> camera;  ///< of the photograph; without it, the photograph must be free of distortion
};

struct CutTarget {
  NewTarget target;
  std::vector<std::string>
      notes;  ///< how far the corners were moved to the edges, and the scale of the patches
};

/// Moves each corner to the intersection of the edges near it, and warps the rectangle to the view from the front. Throws
/// std::invalid_argument with the corner and the remedy: outside of the image, in wrong order, without edges that meet in it, or seen too
/// obliquely.
CutTarget cut_target(const Image& photograph, const TargetCut& cut);

}  // namespace incognita
