#include "incognita/vision/calibration/chessboard.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "incognita/vision/as_matrix.hpp"
#include "incognita/vision/calibration/edge_width.hpp"

namespace incognita {
namespace {

constexpr int least_corners = 3, most_corners = 50;  // per side
/// Half the side of the window in which a corner is refined, px, at most. OpenCV's samples use it for all boards; beyond half a
/// square, however, the window sees the edges of other squares and the corner moves by a pixel.
constexpr int largest_half_window = 11, smallest_half_window = 2;

using Points = std::vector<cv::Point2f>;

/// OpenCV's first detector is fast and the second one finds boards that the first misses, by blur or by light.
bool detect(const cv::Mat& image, const BoardSize& board, Points& corners) {
  const cv::Size size(board.columns, board.rows);
  const int fast = cv::CALIB_CB_ADAPTIVE_THRESH | cv::CALIB_CB_NORMALIZE_IMAGE | cv::CALIB_CB_FAST_CHECK;
  if (cv::findChessboardCorners(image, size, corners, fast)) return true;
  return cv::findChessboardCornersSB(image, size, corners, cv::CALIB_CB_NORMALIZE_IMAGE);
}

double least_side(const Points& corners, const BoardSize& board) {
  double least = std::numeric_limits<double>::infinity();
  const auto at = [&](int row, int column) {
    return corners[static_cast<std::size_t>(row * board.columns + column)];
  };
  for (int r = 0; r < board.rows; ++r)
    for (int c = 0; c < board.columns; ++c) {
      if (c > 0) least = std::min(least, cv::norm(at(r, c) - at(r, c - 1)));
      if (r > 0) least = std::min(least, cv::norm(at(r, c) - at(r - 1, c)));
    }
  return least;
}

}  // namespace

double mean_distance_px(const std::vector<Eigen::Vector2d>& a, const std::vector<Eigen::Vector2d>& b) {
  double same = 0, turned = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    same += (a[i] - b[i]).norm();
    turned += (a[i] - b[b.size() - 1 - i]).norm();
  }
  return std::min(same, turned) / static_cast<double>(a.size());
}

std::optional<BoardSize> parse_board(const std::string& text) {
  BoardSize board;
  const char* const end = text.data() + text.size();
  const auto columns = std::from_chars(text.data(), end, board.columns);
  if (columns.ec != std::errc() || columns.ptr == end || *columns.ptr != 'x') return std::nullopt;
  const auto rows = std::from_chars(columns.ptr + 1, end, board.rows);
  if (rows.ec != std::errc() || rows.ptr != end) return std::nullopt;
  if (std::min(board.columns, board.rows) < least_corners ||
      std::max(board.columns, board.rows) > most_corners)
    return std::nullopt;
  return board;
}

std::optional<Chessboard> find_chessboard(const Image& image, const BoardSize& board) {
  const cv::Mat pixels = as_matrix(image);
  Points corners;
  try {
    if (!detect(pixels, board, corners)) return std::nullopt;
  } catch (const cv::Exception&) {  // an image smaller than the windows of the detector
    return std::nullopt;
  }
  Chessboard found;
  found.least_side_px = least_side(corners, board);
  const int half =
      std::clamp(static_cast<int>(found.least_side_px / 2 - 1), smallest_half_window, largest_half_window);
  cv::cornerSubPix(pixels, corners, {half, half}, {-1, -1},
                   {cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 100, 0.001});
  for (const cv::Point2f& corner : corners) found.corners.emplace_back(corner.x, corner.y);
  found.edge_width_px = incognita::edge_width_px(image, found.corners, board);
  return found;
}

std::optional<BoardSize> largest_board(const Image& image) {
  Points corners;
  cv::Mat meta;
  try {
    const int flags = cv::CALIB_CB_LARGER | cv::CALIB_CB_NORMALIZE_IMAGE;
    if (!cv::findChessboardCornersSB(as_matrix(image), {least_corners, least_corners}, corners, flags, meta))
      return std::nullopt;
  } catch (const cv::Exception&) {
    return std::nullopt;
  }
  return BoardSize{std::max(meta.cols, meta.rows), std::min(meta.cols, meta.rows)};
}

std::optional<BoardSize> most_frequent(const std::vector<BoardSize>& found) {
  std::optional<BoardSize> best;
  const auto count = [&](const BoardSize& board) { return std::count(found.begin(), found.end(), board); };
  for (const BoardSize& board : found) {
    if (!best || count(board) > count(*best) ||
        (count(board) == count(*best) && board.corners() > best->corners()))
      best = board;
  }
  return best;
}

}  // namespace incognita
