// Sharpness of a chessboard: how wide the edges between its squares are.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "incognita/vision/image.hpp"

namespace incognita {

struct BoardSize;

/// Width in px over which the gray level rises from 10 to 90 % between the centers of two neighboring squares, across their edge: the
/// mean over the board of the edges along its rows or of those along its columns, whichever is larger (motion blurs one of them). As in
/// OpenCV's estimateChessboardSharpness, which writes to standard output. `corners`: row by row, px.
double edge_width_px(const Image& image, const std::vector<Eigen::Vector2d>& corners, const BoardSize& board);

}  // namespace incognita
