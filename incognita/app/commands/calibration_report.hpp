// What `incognita calibrate` answers: as text, as JSON, and as the comment of a calibration file.
#pragma once

#include <string>

#include "incognita/io/scenario/scenario.hpp"
#include "incognita/vision/calibration/calibrate_camera.hpp"

namespace incognita {

struct CalibrationAnswer {
  const CalibrationViews& views;
  const CameraCalibration& calibration;
  std::string board_source;  ///< "given", "guessed: 8 of 8 images show it"
  double square_m = 0;       ///< 0: not given; distances are then in squares
  std::string written;       ///< the output file; empty without one
};

std::string calibration_report(const CalibrationAnswer& answer);
std::string calibration_json(const CalibrationAnswer& answer);
/// Standard deviations and residuals, for whoever reads the file later.
std::string calibration_comment(const CalibrationAnswer& answer);

/// The camera that was fitted.
CameraSettings camera_settings(const LensFit& lens, int width_px, int height_px);

}  // namespace incognita
