// Chessboards in images: the inner corners where four squares meet, to a fraction of a pixel.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "incognita/vision/image.hpp"

namespace incognita {

/// Inner corners per row and per column of squares: a board of 10x7 squares has 9x6.
struct BoardSize {
  int columns = 0, rows = 0;

  int corners() const { return columns * rows; }
  std::string text() const { return std::to_string(columns) + "x" + std::to_string(rows); }
  /// Whether the boards are the same up to a quarter turn.
  bool is_like(const BoardSize& other) const {
    return (columns == other.columns && rows == other.rows) ||
           (columns == other.rows && rows == other.columns);
  }
  bool operator==(const BoardSize&) const = default;
};

struct Chessboard {
  std::vector<Eigen::Vector2d> corners;  ///< row by row, px; (0, 0) is the center of the first pixel
  double least_side_px = 0;              ///< of the squares between the corners
  double edge_width_px = 0;              ///< see edge_width.hpp
};

/// Mean distance in px of the corners of the same board in two images, whichever end of it is the first.
double mean_distance_px(const std::vector<Eigen::Vector2d>& a, const std::vector<Eigen::Vector2d>& b);

/// Size from the text "9x6"; nothing unless it has two numbers of 3 to 50.
std::optional<BoardSize> parse_board(const std::string& text);

/// The board with all of its corners; nothing if it is not in the image as a whole.
std::optional<Chessboard> find_chessboard(const Image& image, const BoardSize& board);

/// The size of the largest board in the image. May be less than the printed one, where that is partly hidden.
std::optional<BoardSize> largest_board(const Image& image);

/// The size that most of the images show, with more columns than rows; of equally many the one with more corners.
std::optional<BoardSize> most_frequent(const std::vector<BoardSize>& found);

}  // namespace incognita
