// Chessboards before a camera of known intrinsics, rendered ray by ray.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "incognita/math/random.hpp"
#include "incognita/models/sensors/camera.hpp"
#include "incognita/vision/calibration/chessboard.hpp"
#include "incognita/vision/image.hpp"

namespace incognita::testing {

/// Place of the board: its center in camera axes (unit: a square), tilted about the x and y axes and turned in its plane, rad.
struct BoardPlace {
  Eigen::Vector3d center;
  double tilt_x = 0, tilt_y = 0, turn = 0;
};

struct Photograph {
  double sigma_gray = 2, blur_px = 0.7;  ///< noise; sigma of the blur
  double stretch = 1;                    ///< of the squares in x: a print that is not true
  std::uint64_t seed = 1;
};

/// Gray of the plane of the board at (x, y), in squares from its center: black and white squares in a white margin of one
/// square on a gray wall.
inline double board_gray(const BoardSize& board, double x, double y) {
  const double column = x + (board.columns + 1) / 2.0, row = y + (board.rows + 1) / 2.0;
  if (column < -1 || row < -1 || column > board.columns + 2 || row > board.rows + 2) return 110;
  if (column < 0 || row < 0 || column > board.columns + 1 || row > board.rows + 1) return 225;
  return (static_cast<int>(column) + static_cast<int>(row)) % 2 == 0 ? 30 : 225;
}

/// Gaussian blur of standard deviation `sigma_px` by rows and columns.
inline void blur(std::vector<double>& gray, int width, int height, double sigma_px) {
  const int reach = static_cast<int>(std::ceil(3 * sigma_px));
  std::vector<double> weights;
  for (int i = -reach; i <= reach; ++i) weights.push_back(std::exp(-0.5 * i * i / (sigma_px * sigma_px)));
  for (const bool along_rows : {true, false}) {
    std::vector<double> out(gray.size());
    for (int v = 0; v < height; ++v)
      for (int u = 0; u < width; ++u) {
        double sum = 0, total = 0;
        for (int i = -reach; i <= reach; ++i) {
          const int x = std::clamp(along_rows ? u + i : u, 0, width - 1),
                    y = std::clamp(along_rows ? v : v + i, 0, height - 1);
          const double weight = weights[static_cast<std::size_t>(i + reach)];
          sum += weight * gray[static_cast<std::size_t>(y) * width + x], total += weight;
        }
        out[static_cast<std::size_t>(v) * width + u] = sum / total;
      }
    gray = out;
  }
}

/// A camera that takes photographs of boards, with 3x3 rays per pixel.
class BoardPhotographer {
 public:
  BoardPhotographer(const Camera& camera, const BoardSize& board)
      : board_(board), width_(camera.width()), height_(camera.height()) {
    for (int v = 0; v < height_; ++v)
      for (int u = 0; u < width_; ++u)
        for (int i = 0; i < 9; ++i)
          rays_.push_back(camera.unproject({u + (i % 3 - 1) / 3.0, v + (i / 3 - 1) / 3.0})
                              .value_or(Eigen::Vector3d::Zero()));
  }

  static Eigen::Matrix3d camera_from_board(const BoardPlace& place) {
    using Eigen::AngleAxisd, Eigen::Vector3d;
    return (AngleAxisd(place.tilt_x, Vector3d::UnitX()) * AngleAxisd(place.tilt_y, Vector3d::UnitY()) *
            AngleAxisd(place.turn, Vector3d::UnitZ()))
        .toRotationMatrix();
  }

  Image take(const BoardPlace& place, const Photograph& how = {}) const {
    const Eigen::Matrix3d R = camera_from_board(place);
    std::vector<double> gray(static_cast<std::size_t>(width_) * height_);
    for (std::size_t i = 0; i < gray.size(); ++i) {
      double sum = 0;
      for (std::size_t k = 0; k < 9; ++k) sum += gray_along(rays_[9 * i + k], place, R, how.stretch);
      gray[i] = sum / 9;
    }
    if (how.blur_px > 0) blur(gray, width_, height_, how.blur_px);
    RandomStream random(how.seed, "photograph");
    Image image(width_, height_);
    for (std::size_t i = 0; i < gray.size(); ++i)
      image.row(0)[i] =
          static_cast<std::uint8_t>(std::clamp(gray[i] + how.sigma_gray * random.normal(), 0.0, 255.0));
    return image;
  }

 private:
  double gray_along(const Eigen::Vector3d& ray, const BoardPlace& place, const Eigen::Matrix3d& R,
                    double stretch) const {
    const double along = R.col(2).dot(ray);
    const double scale = along != 0 ? R.col(2).dot(place.center) / along : -1;
    if (!(scale > 0)) return 110;
    const Eigen::Vector3d at = R.transpose() * (scale * ray - place.center);
    return board_gray(board_, at.x() / stretch, at.y());
  }

  BoardSize board_;
  int width_, height_;
  std::vector<Eigen::Vector3d> rays_;
};

/// Places of a board of 9x6 corners as a careful user shows it: all over the image, tilted about both axes. `focal`: focal length over
/// the width of the image.
inline std::vector<BoardPlace> careful_places(double focal, int count) {
  std::vector<BoardPlace> places;
  RandomStream random(3, "places");
  for (int i = 0; i < count; ++i) {
    const double distance = focal * 16 * random.uniform(0.85, 1.3), side = distance / focal;
    places.push_back({{random.uniform(-0.22, 0.22) * side, random.uniform(-0.16, 0.16) * side, distance},
                      random.uniform(-0.6, 0.6),
                      random.uniform(-0.6, 0.6),
                      random.uniform(-0.3, 0.3)});
  }
  return places;
}

}  // namespace incognita::testing
