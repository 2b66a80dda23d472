// Where the pixels of a target's picture belong.
#pragma once

#include "incognita/slam/features/target.hpp"

namespace incognita {

/// A picture of the whole target, by where its corners are in it: `corner_px` has a row for each, u and v,
/// px, (0, 0) the middle of the first pixel. No finer than what a camera sees of a target: kept are means, of
/// 100 px a side at the most. Throws std::invalid_argument that says what the picture must be: straight on
/// and not mirrored, its pixels square, the corners inside, apart, and where they belong to a quarter of a
/// pixel.
Target::Picture target_picture_from(const Target& target, const Image& whole,
                                    const Eigen::MatrixX2d& corner_px);

}  // namespace incognita
