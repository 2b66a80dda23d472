// Descriptors of the surroundings of a corner that tolerate rotation in the image plane, moderate changes of viewpoint
// and of scale, and any change of brightness and contrast: histograms of gradients relative to a dominant orientation
// (D. Lowe, "Distinctive image features from scale-invariant keypoints", IJCV 2004).
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "incognita/vision/image.hpp"

namespace incognita {

/// 4 x 4 cells with 8 directions each.
inline constexpr int descriptor_size = 128;

struct Descriptor {
  std::array<std::uint8_t, descriptor_size> bins{};
  double angle_rad = 0;  ///< of the dominant orientation in the image, from +u towards +v
};

/// Side of the described square, px.
inline constexpr double described_px = 24;

/// Appends a descriptor of the square around `pixel` for each of its dominant orientations, at most `max_orientations`:
/// the strongest, and those of at least 0.8 of its weight. None for a square without contrast. Pixels outside the image
/// count like its border.
void describe(const Image& image, const Eigen::Vector2d& pixel, int max_orientations,
              std::vector<Descriptor>& out);

/// Squared Euclidean distance; about 400^2 to 600^2 between unrelated squares, below 250^2 between views of the same one.
/// Beyond `limit` any number above it.
int squared_distance(const Descriptor& a, const Descriptor& b, int limit = std::numeric_limits<int>::max());

}  // namespace incognita
