// A calibration from a camera that sends images while the operator moves the board: good views are taken by themselves.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "incognita/vision/calibration/calibrate_camera.hpp"

namespace incognita {

struct LiveCalibrationSettings {
  std::optional<BoardSize> board;  ///< none: the size that the first images show
  CalibrationSettings fit = {};
};

/// What became of the newest image.
struct JudgedImage {
  std::string refusal;                   ///< why it is no view; empty if it is one
  std::vector<Eigen::Vector2d> corners;  ///< that were found, row by row, px
};

class LiveCalibration {
 public:
  /// As many views should determine a camera; each further one makes the fit slower. Twice as many are taken if they do not.
  static constexpr std::size_t most_views = 30;

  explicit LiveCalibration(const LiveCalibrationSettings& settings);

  /// Judges an image, and takes it if it is a view. The lens is fitted again after each of the first ten views, then after every
  /// fifth: the time of a fit grows with their number. `t`: when the image was taken, s.
  void add(double t, const Image& image);
  /// Fits the lens to all views, unless it is.
  void finish();
  /// Forgets all views and the board, unless that was given.
  void restart();

  const JudgedImage& newest() const { return newest_; }
  std::size_t images() const { return images_; }
  /// The views that were taken, and among them those that the last fit refused as outliers. None until the size of the board is known.
  const std::optional<CalibrationViews>& views() const { return fitted_views_; }
  /// The last fit; with a refusal as long as the views do not determine the camera.
  const CameraCalibration& calibration() const { return calibration_; }
  bool board_is_guessed() const { return !settings_.board; }

 private:
  void guess_board(const Image& image);
  std::string why_moving(double t, const std::vector<Eigen::Vector2d>& corners) const;
  bool is_full();
  void take(const CalibrationView& view);
  void fit();

  struct Seen {
    double t;
    std::vector<Eigen::Vector2d> corners;
  };

  LiveCalibrationSettings settings_;
  std::vector<BoardSize> shown_;  ///< by the images, until the board is known
  std::optional<CalibrationViews>
      taken_;  ///< all are in use: whether one is an outlier depends on the others
  std::optional<CalibrationViews> fitted_views_;
  std::optional<Seen> last_;  ///< the board in the image before
  CameraCalibration calibration_;
  JudgedImage newest_;
  std::size_t images_ = 0, unfitted_ = 0;  ///< views since the last fit
};

}  // namespace incognita
