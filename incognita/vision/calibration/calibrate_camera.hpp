// Intrinsics of a camera from views of a chessboard, or the reason why the views do not determine them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "incognita/vision/calibration/calibration_views.hpp"
#include "incognita/vision/calibration/fit_lens.hpp"

namespace incognita {

struct CalibrationSettings {
  enum class Model { automatic, pinhole, fisheye };
  Model model = Model::automatic;
  std::size_t most_views =
      60;  ///< of many, as from a video, those that differ most are used: the time grows with their cube
  bool allow_third_radial = true;  ///< whether a pinhole may have k3; Kalibr's files cannot hold it
};

struct CameraCalibration {
  std::string refusal;              ///< why there is no calibration; the rest is then what is known
  std::optional<LensFit> lens;      ///< of the views in use
  std::vector<double> view_rms_px;  ///< per view of CalibrationViews; NaN for one that is not used
  std::vector<std::optional<BoardPose>> boards;  ///< the same
  std::vector<std::string> notes;                ///< how the model was chosen, and what limits the accuracy
};

/// At least this many views: two determine the focal length of a perfect camera, and one view more than the parameters need
/// shows no mistake yet.
inline constexpr std::size_t least_views = 5;

/// Fits the lens, refuses views whose corners contradict the others, and refuses the result if the views are too few, cover too
/// little of the image or do not determine focal length and principal point.
CameraCalibration calibrate_camera(CalibrationViews& views, const CalibrationSettings& settings);

}  // namespace incognita
