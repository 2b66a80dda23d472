// The size of the chessboard that images show, for users who do not say it, or say a wrong one.
#pragma once

#include <optional>

#include "incognita/vision/calibration/chessboard.hpp"
#include "incognita/vision/image_source.hpp"

namespace incognita {

struct GuessedBoard {
  std::optional<BoardSize> board;    ///< the most frequent one; nothing if no image shows a board
  std::size_t shown = 0, tried = 0;  ///< numbers of images that show this board, and that were searched
  std::string example;               ///< name of the first image that shows it
};

/// Searches images spread over the source, from its first, for their largest board, until enough of them show one.
GuessedBoard guess_board(ImageSource& images);

}  // namespace incognita
