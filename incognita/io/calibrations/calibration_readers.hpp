// The readers of single formats, for the sources of this folder only. Each throws InputError naming file, line and remedy.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "incognita/io/calibrations/read_calibration.hpp"
#include "incognita/io/calibrations/yaml_map.hpp"

namespace incognita {

constexpr std::size_t largest_calibration = 1 << 20;  // bytes; files have some hundreds

/// Refuses a size that differs from the requested one.
void check_size(const CameraSettings& camera, const std::filesystem::path& file,
                const CalibrationRequest& request);

/// Sets width and height from the file, or from the request where the file has none; refuses two that differ.
void set_size(CameraSettings& camera, const std::filesystem::path& file,
              std::optional<std::pair<double, double>> in_file, const CalibrationRequest& request);

/// Sets the model from coefficients in the order of the field: k1 k2 p1 p2 k3 of a pinhole, k1 k2 k3 k4 of a fisheye. Returns
/// why the model cannot hold them, or an empty text. Further coefficients must be 0.
std::string set_lens(CameraSettings& camera, bool fisheye, const std::vector<double>& coefficients);

/// Focal lengths and principal point from a 3x3 matrix, row by row. Returns why it is none, or an empty text.
std::string set_matrix(CameraSettings& camera, const std::vector<double>& matrix);

bool is_kalibr(const YamlMap& map);
bool is_opencv(const YamlMap& map);
bool is_ros(const YamlMap& map);
bool is_euroc(const YamlMap& map);
bool is_kitti(const std::string& text);
CalibrationFile read_kalibr(const YamlMap& map, const std::filesystem::path& file,
                            const CalibrationRequest& request);
CalibrationFile read_ros(const YamlMap& map, const std::filesystem::path& file,
                         const CalibrationRequest& request);
CalibrationFile read_opencv(const YamlMap& map, const std::filesystem::path& file,
                            const CalibrationRequest& request);
/// The numbers in XML of OpenCV as YAML text with the same line numbers, which the reader above reads.
std::string opencv_xml_as_yaml(const std::filesystem::path& file, const std::string& text);
CalibrationFile read_euroc(const YamlMap& map, const std::filesystem::path& file);
CalibrationFile read_kitti(const std::string& text, const std::filesystem::path& file,
                           const CalibrationRequest& request);
bool is_plain(const std::string& text);
CalibrationFile read_plain(const std::string& text, const std::filesystem::path& file,
                           const CalibrationRequest& request);
CalibrationFile read_camera_table(const std::string& text, const std::filesystem::path& file);

}  // namespace incognita
