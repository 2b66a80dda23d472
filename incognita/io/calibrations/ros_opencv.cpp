// Camera matrix and distortion coefficients as ROS and OpenCV write them: the same words, since ROS took OpenCV's.
// ROS: camera_info of camera_calibration_parsers, http://wiki.ros.org/camera_calibration_parsers
// OpenCV: what its calibration sample writes by FileStorage, and the usual variants of its keys.
#include <fmt/format.h>

#include <initializer_list>

#include "incognita/io/calibrations/calibration_readers.hpp"

namespace incognita {
namespace {

using Keys = std::initializer_list<const char*>;
constexpr Keys matrix_keys = {
    "camera_matrix", "Camera_Matrix", "cameraMatrix", "intrinsic_matrix", "K", "M1", "mtx"};
constexpr Keys distortion_keys = {"distortion_coefficients",
                                  "Distortion_Coefficients",
                                  "distCoeffs",
                                  "dist_coeffs",
                                  "dist_coeff",
                                  "D",
                                  "D1",
                                  "dist"};
constexpr Keys width_keys = {"image_width", "image_Width", "width"},
               height_keys = {"image_height", "image_Height", "height"};
constexpr Keys size_keys = {"image_size", "imageSize"};

const char* key_in(const YamlMap& map, Keys keys) {
  for (const char* key : keys)
    if (map.has(key)) return key;
  return nullptr;
}

std::optional<std::pair<double, double>> size_in(const YamlMap& map) {
  const char *width = key_in(map, width_keys), *height = key_in(map, height_keys);
  if (width && height) return {{map.number(width), map.number(height)}};
  const char* both = key_in(map, size_keys);
  if (!both) return std::nullopt;
  const std::vector<double> size = map.numbers(both);
  if (size.size() != 2) map.refuse(both, "must be width and height in px");
  return {{size[0], size[1]}};
}

void matrix_from(CameraSettings& camera, const YamlMap& map) {
  const char* key = key_in(map, matrix_keys);
  if (!key) map.refuse("camera_matrix", "is missing");
  if (const std::string wrong = set_matrix(camera, map.matrix(key)); !wrong.empty()) map.refuse(key, wrong);
}

std::vector<double> distortion_in(const YamlMap& map) {
  const char* key = key_in(map, distortion_keys);
  return key ? map.matrix(key) : std::vector<double>{};
}

bool says_yes(const YamlMap& map, const char* key) {
  const std::string word = map.word(key);
  return !word.empty() && word != "0" && word != "false";
}

}  // namespace

bool is_opencv(const YamlMap& map) { return key_in(map, matrix_keys) != nullptr; }

bool is_ros(const YamlMap& map) {
  return map.has("camera_matrix") && (map.has("distortion_model") || map.has("projection_matrix"));
}

CalibrationFile read_ros(const YamlMap& map, const std::filesystem::path& file,
                         const CalibrationRequest& request) {
  CalibrationFile found{CalibrationFormat::ros, {file, {}, ""}, {}};
  CameraSettings& camera = found.calibrated.camera;
  matrix_from(camera, map);
  set_size(camera, file, size_in(map), request);
  const std::string lens = map.word("distortion_model");
  const bool fisheye = lens == "equidistant" || lens == "fisheye";
  const bool known =
      fisheye || lens.empty() || lens == "plumb_bob" || lens == "rational_polynomial" || lens == "none";
  found.calibrated.unfit =
      known ? set_lens(camera, fisheye, distortion_in(map)) : fmt::format("distortion_model is `{}`", lens);
  if (map.has("projection_matrix"))
    found.notes.push_back(
        "camera_matrix and the distortion are taken, which hold for the images as they come; projection_matrix, of rectified images, is not used");
  return found;
}

CalibrationFile read_opencv(const YamlMap& map, const std::filesystem::path& file,
                            const CalibrationRequest& request) {
  CalibrationFile found{CalibrationFormat::opencv, {file, {}, ""}, {}};
  CameraSettings& camera = found.calibrated.camera;
  matrix_from(camera, map);
  set_size(camera, file, size_in(map), request);
  const bool fisheye = says_yes(map, "fisheye_model");
  const std::vector<double> coefficients = distortion_in(map);
  if (!fisheye && !map.has("fisheye_model") && coefficients.size() == 4)
    found.notes.push_back(
        "its 4 distortion coefficients are taken for k1 k2 p1 p2; those of the fisheye module need the line `fisheye_model: 1`");
  if (map.has("M2")) found.notes.push_back("the second camera of the pair (M2, D2) is not used");
  found.calibrated.unfit = set_lens(camera, fisheye, coefficients);
  return found;
}

}  // namespace incognita
