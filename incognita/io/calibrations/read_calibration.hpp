// Reads the camera from a calibration file of the usual formats.
//
// All of them share the pixel convention of this program: (0, 0) is the center of the first pixel (models/sensors/camera.hpp),
// since all of them come from corners that were detected by OpenCV or with its convention.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "incognita/io/calibrations/calibrated_camera.hpp"

namespace incognita {

enum class CalibrationFormat {
  kalibr,    ///< camchain.yaml
  ros,       ///< camera_info YAML
  opencv,    ///< FileStorage: YAML, XML or JSON
  euroc,     ///< sensor.yaml
  kitti,     ///< calib.txt, calib_cam_to_cam.txt: rectified images
  plain,     ///< a name and a number per line: fx 420.5
  incognita  ///< the [camera] of a scenario
};

/// "Kalibr camchain", ...: for messages.
const char* name_of(CalibrationFormat format);

struct CalibrationRequest {
  /// Of a file with several: "cam1", "P2"; empty: the first one. Refused for the formats with one camera.
  std::string camera;
  std::optional<std::pair<int, int>> image_size_px =
      {};  ///< width and height, for files without them; others must agree
  std::string size_remedy =
      "give it with --image-size WIDTHxHEIGHT, or add it to the file";  ///< for a file without them, for messages
};

struct CalibrationFile {
  CalibrationFormat format;
  CalibratedCamera calibrated;
  std::vector<std::string> notes;  ///< what of the file is not used
};

/// Guesses the format from the content. `calibrated.unfit` says why no camera model holds the camera. Throws InputError naming
/// file, line and remedy for anything else.
CalibrationFile read_calibration_file(const std::filesystem::path& file,
                                      const CalibrationRequest& request = {});

/// The camera in a file of any of the formats. Throws InputError, also for a camera that no model holds, or whose values
/// contradict each other.
CameraSettings read_calibration(const std::filesystem::path& file, const CalibrationRequest& request = {});

/// Throws InputError naming the file unless the camera is one that this program can use.
void check_calibrated(const CalibratedCamera& calibrated);

}  // namespace incognita
