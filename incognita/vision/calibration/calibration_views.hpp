// The views of a calibration, taken or refused one by one as they come: from files, a video or a camera.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "incognita/vision/calibration/chessboard.hpp"
#include "incognita/vision/calibration/coverage.hpp"
#include "incognita/vision/image.hpp"

namespace incognita {

struct CalibrationView {
  std::string name;
  std::vector<Eigen::Vector2d> corners;  ///< row by row, px; empty if there is no board
  double edge_width_px = 0;              ///< see Chessboard
  std::string refusal;                   ///< why the view is not used; empty if it is
};

class CalibrationViews {
 public:
  explicit CalibrationViews(BoardSize board) : board_(board) {}

  /// Searches the board and decides whether the view is of use: refused are views without the whole board, of another size than
  /// the first image, blurred, too small or oblique, or nearly the same as one before. The reference is valid until the next call.
  const CalibrationView& add(const std::string& name, const Image& image);
  /// A view of the same board that was judged before.
  void add(const CalibrationView& view) { views_.push_back(view); }
  /// Forgets the view that was added last.
  void drop_newest() { views_.pop_back(); }
  /// An image that could not be read.
  void add_unreadable(const std::string& name, const std::string& reason);

  const BoardSize& board() const { return board_; }
  const std::vector<CalibrationView>& views() const { return views_; }
  std::size_t used() const;
  int width_px() const { return width_px_; }
  int height_px() const { return height_px_; }
  /// Of the views in use.
  Coverage coverage() const;

  /// Refuses all but the views that differ most, if more than `most` are in use.
  void keep_most_different(std::size_t most);
  /// Refuses a view that was in use until now.
  void refuse(std::size_t view, const std::string& reason) { views_[view].refusal = reason; }

 private:
  std::string why_refused(const Image& image, CalibrationView& view) const;
  std::string why_similar(const CalibrationView& view) const;

  BoardSize board_;
  std::vector<CalibrationView> views_;
  int width_px_ = 0, height_px_ = 0;  ///< of the first image
};

}  // namespace incognita
