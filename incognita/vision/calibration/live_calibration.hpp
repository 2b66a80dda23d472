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
  /// As many views determine a camera; each further one makes the fit slower.
  static constexpr std::size_t most_views = 40;

  explicit LiveCalibration(const LiveCalibrationSettings& settings);

  /// Judges an image, and fits the lens again if it is a view. `t`: when it was taken, s.
  void add(double t, const Image& image);
  /// Forgets all views and the board, unless that was given.
  void restart();

  const JudgedImage& newest() const { return newest_; }
  std::size_t images() const { return images_; }
  /// The views that the last fit used, and those that it refused as outliers. None until the size of the board is known.
  const std::optional<CalibrationViews>& views() const { return fitted_views_; }
  /// Of these views; with a refusal as long as they do not determine the camera.
  const CameraCalibration& calibration() const { return calibration_; }
  bool board_is_guessed() const { return !settings_.board; }

 private:
  void guess_board(const Image& image);
  std::string why_moving(double t, const std::vector<Eigen::Vector2d>& corners) const;
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
  std::size_t images_ = 0;
};

}  // namespace incognita
