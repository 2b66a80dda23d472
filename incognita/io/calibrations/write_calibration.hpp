// Writes a camera in the usual formats of calibrations.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "incognita/io/calibrations/read_calibration.hpp"

namespace incognita {

/// By the word of a user: kalibr, ros, opencv, incognita; nothing for another one.
std::optional<CalibrationFormat> written_format(const std::string& word);

/// By the name of a file: .toml is incognita's, names with `camchain` Kalibr's, with `camera_info` or `ros` those of ROS, and other
/// .yaml and .yml OpenCV's; nothing for another ending.
std::optional<CalibrationFormat> guess_written_format(const std::filesystem::path& file);

/// Why files of the format cannot hold the camera; empty if they can.
std::string why_not_held(const CameraSettings& camera, CalibrationFormat format);

/// The content of a file of one of the written formats. `comment`: lines to put in front, without comment sign. Throws InputError
/// for a camera that the format cannot hold, saying which ones can.
std::string calibration_text(const CameraSettings& camera, CalibrationFormat format,
                             const std::string& comment = "");

}  // namespace incognita
