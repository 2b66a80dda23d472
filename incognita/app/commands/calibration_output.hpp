// The end of a calibration: the report on standard output, and the calibration file.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "incognita/io/calibrations/read_calibration.hpp"
#include "incognita/vision/calibration/calibrate_camera.hpp"

namespace incognita {

struct CalibrationOutput {
  std::filesystem::path file;
  CalibrationFormat format = CalibrationFormat::incognita;
};

/// What --out and --format ask for; nothing if both are empty. To be called before the work: throws InputError for a folder that does
/// not exist, a format that is not known, and a file that must not be replaced.
std::optional<CalibrationOutput> calibration_output(const std::string& out, const std::string& format);

struct CalibrationReporting {
  std::string board_source;  ///< "given", "guessed: 8 of 8 images show it"
  double square_m = 0;       ///< 0: not given
  bool json = false;         ///< one JSON document instead of text
};

/// Refuses a lens that has no ray for some pixels: its polynomial folds within the image.
void refuse_useless_lens(const CalibrationViews& views, CameraCalibration& calibration);

/// Says that no image shows a board. Returns the exit code, 1.
int refuse_without_board(bool json);

/// Reports the calibration, and writes it unless it is refused. Returns the exit code: 1 if it is. Throws RecordError, after the report,
/// if the file cannot be written.
int conclude_calibration(const CalibrationViews& views, CameraCalibration& calibration,
                         const CalibrationReporting& reporting,
                         const std::optional<CalibrationOutput>& output);

}  // namespace incognita
