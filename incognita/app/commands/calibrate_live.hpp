// `incognita calibrate --view`: a calibration by the camera of a device that has the page open.
#pragma once

#include <optional>
#include <utility>

#include "incognita/app/commands/calibration_output.hpp"
#include "incognita/app/commands/page_options.hpp"
#include "incognita/vision/calibration/live_calibration.hpp"

namespace incognita {

struct CalibrateLiveOptions {
  PageOptions page;
  LiveCalibrationSettings settings;
  std::optional<std::pair<int, int>>
      image_size_px;  ///< width and height that the camera is asked for; none: its own
  CalibrationReporting reporting;
  CalibrationOutput output;
};

/// Serves the page until a viewer finishes the calibration or the program is interrupted; both end it with the views that there are.
/// Returns the exit code: 1 if the views do not determine the camera.
int calibrate_live(const CalibrateLiveOptions& options);

}  // namespace incognita
