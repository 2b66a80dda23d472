// An image at several resolutions, each half of the one before, for searches from coarse to fine.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "incognita/vision/search.hpp"

namespace incognita {

/// The image, smoothed and halved in width and height. `half` keeps its memory if the size is the same as before.
void halve(const Image& image, Image& half);

/// Pixel (u, v) of level 0 lies at (u, v) / 2^level of a level.
inline Eigen::Vector2d at_level(const Eigen::Vector2d& pixel, int level) {
  return pixel / static_cast<double>(1 << level);
}

/// Level 0 is the image itself. Allocates only when the size of the images changes.
class ImagePyramid {
 public:
  static constexpr int max_levels = 4, min_side_px = 48;

  ImagePyramid() = default;
  explicit ImagePyramid(const Image& image, int most_levels = max_levels) { assign(image, most_levels); }
  /// A copy has levels of its own but for the image itself, level 0.
  ImagePyramid(const ImagePyramid& other);
  ImagePyramid& operator=(const ImagePyramid& other) { return *this = ImagePyramid(other); }
  ImagePyramid(ImagePyramid&&) = default;
  ImagePyramid& operator=(ImagePyramid&&) = default;

  /// As many levels as keep min_side_px in both directions, at most `most_levels`. Keeps a pointer to the image, which must
  /// outlive this object.
  void assign(const Image& image, int most_levels = max_levels);

  int levels() const { return levels_; }
  const Image& image(int level = 0) const { return summed(level).image(); }
  const SummedImage& summed(int level = 0) const { return summed_[static_cast<std::size_t>(level)]; }

 private:
  int levels_ = 0;
  std::vector<Image> halves_ = std::vector<Image>(max_levels - 1);  ///< levels 1 and up
  std::vector<SummedImage> summed_ = std::vector<SummedImage>(max_levels);
};

}  // namespace incognita
