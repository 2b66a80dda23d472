#include "incognita/vision/calibration/guess_board.hpp"

#include <algorithm>
#include <vector>

namespace incognita {
namespace {

constexpr std::size_t enough_boards = 8, most_tries = 40;
constexpr int least_columns = 4;  // the detector takes accidental textures for boards of 3x3

}  // namespace

GuessedBoard guess_board(ImageSource& images) {
  GuessedBoard guess;
  std::vector<BoardSize> found;
  std::vector<std::string> names;
  images.rewind();
  const std::size_t stride = std::max<std::size_t>(1, images.count() / most_tries);
  while (found.size() < enough_boards && guess.tried < most_tries) {
    const auto image = images.next();
    if (!image) break;
    for (std::size_t i = 1; i < stride; ++i) images.skip();
    if (!image->failure.empty()) continue;
    ++guess.tried;
    const auto board = largest_board(image->image);
    if (!board || board->columns < least_columns) continue;
    found.push_back(*board);
    names.push_back(image->name);
  }
  guess.board = most_frequent(found);
  if (!guess.board) return guess;
  guess.shown = static_cast<std::size_t>(std::count(found.begin(), found.end(), *guess.board));
  const auto first = std::find(found.begin(), found.end(), *guess.board);
  guess.example = names[static_cast<std::size_t>(first - found.begin())];
  return guess;
}

}  // namespace incognita
