// Fits focal lengths, principal point and distortion to views of a chessboard: OpenCV's calibrateCamera and fisheye::calibrate,
// with the standard deviations of both.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "incognita/vision/calibration/chessboard.hpp"

namespace incognita {

enum class LensModel {
  pinhole,  ///< Brown's k1 k2 p1 p2 k3, as OpenCV
  fisheye   ///< Kannala and Brandt's k1 k2 k3 k4, as OpenCV's fisheye module and Kalibr's `equidistant`
};

/// A parameter with its standard deviation, which follows from the residuals; 0 for a parameter that is not fitted.
struct FittedValue {
  double value = 0, sigma = 0;
};

/// Of a board before the camera.
struct BoardPose {
  double distance = 0;  ///< of its center from the camera, in squares
  double tilt_rad = 0;  ///< between its normal and the optical axis
};

struct LensFit {
  LensModel model = LensModel::pinhole;
  FittedValue fu, fv, u0, v0;           ///< px
  std::vector<FittedValue> distortion;  ///< k1 k2 p1 p2 k3, or k1 k2 k3 k4
  double rms_px = 0;                    ///< of the distances between corners and their projections
  std::vector<double> view_rms_px;      ///< the same per view
  std::vector<BoardPose> boards;        ///< per view
  std::string failure;                  ///< why the optimization has no result; the rest is then not valid
};

struct LensFitSettings {
  LensModel model = LensModel::pinhole;
  bool third_radial = true;  ///< whether k3 of a pinhole is fitted; else it is 0
};

/// `views`: the corners of each view, row by row. The size of a square does not matter. `failure` says why there is no result.
LensFit fit_lens(const std::vector<std::vector<Eigen::Vector2d>>& views, const BoardSize& board, int width_px,
                 int height_px, const LensFitSettings& settings);

}  // namespace incognita
