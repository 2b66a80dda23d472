// Which parts of the image the corners of all boards cover: distortion is known only where there were corners.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace incognita {

class Coverage {
 public:
  static constexpr int columns = 8, rows = 6;

  Coverage(int width_px, int height_px) : width_px_(width_px), height_px_(height_px) {}

  void add(const std::vector<Eigen::Vector2d>& corners);

  int count(int row, int column) const { return counts_[static_cast<std::size_t>(row * columns + column)]; }
  /// Share of the cells with a corner, in [0, 1].
  double share() const;
  /// One line per row of cells: their numbers of corners, `.` without one.
  std::string grid() const;
  /// The parts of the image in which less than half of the cells have a corner: "left, upper right"; empty if there is none.
  std::string gaps() const;

 private:
  int width_px_, height_px_;
  std::vector<int> counts_ = std::vector<int>(static_cast<std::size_t>(columns) * rows, 0);
};

}  // namespace incognita
