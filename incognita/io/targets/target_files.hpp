// A target as the files that read_target() reads: a TOML file, an image per corner, and a picture of the whole.
#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "incognita/vision/image.hpp"

namespace incognita {

struct NewTarget {
  struct Corner {
    Eigen::Vector2d
        position_m;  ///< right and down from the center of the target, as seen from the printed side
    Image patch;     ///< odd square, the corner is its center pixel
    Eigen::Vector2d picture_px{0.0, 0.0};  ///< in the picture, the center of the first pixel is (0, 0)
  };
  std::string comment;  ///< lines without comment sign; the first one names `incognita target`, its program
  std::vector<Corner> corners;
  Image picture;  ///< frontal, with square pixels
};

/// Name and content of each file; the first is NAME.toml. The target is in the plane x = 0 of the world, its center at the origin and
/// its printed side towards -x, so that a camera that looks along +x sees it upright.
std::vector<std::pair<std::string, std::string>> target_files(const NewTarget& target,
                                                              const std::string& name);

/// Whether the text of a .toml file begins with the comment of a target that `incognita target` wrote.
bool is_written_target(std::string_view toml);

}  // namespace incognita
