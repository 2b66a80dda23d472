#include "incognita/io/calibrations/write_calibration.hpp"

#include <fmt/format.h>

#include <cctype>
#include <sstream>
#include <vector>

#include "incognita/io/scenario/scenario_tree.hpp"
#include "incognita/messages/errors.hpp"

namespace incognita {
namespace {

/// The shortest number that reads back exactly. YAML 1.1, as PyYAML reads it, takes `1e-05` for a text and `1.0e-05` for a number.
std::string yaml_number(double value) {
  std::string text = fmt::format("{}", value);
  const std::size_t exponent = text.find('e');
  if (text.find('.') != std::string::npos) return text;
  return exponent == std::string::npos ? text + ".0" : text.insert(exponent, ".0");
}

std::string yaml_list(const std::vector<double>& values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : ", ") + yaml_number(value);
  return "[" + text + "]";
}

std::string commented(const std::string& comment) {
  std::string text;
  std::istringstream lines(comment);
  for (std::string line; std::getline(lines, line);) text += line.empty() ? "#\n" : "# " + line + "\n";
  return text;
}

bool has_fisheye(const CameraSettings& camera) { return std::holds_alternative<FisheyeLens>(camera.model); }

/// k1 k2 p1 p2 k3 of a pinhole, k1 k2 k3 k4 of a fisheye.
std::vector<double> coefficients(const CameraSettings& camera) {
  if (const auto* lens = std::get_if<FisheyeLens>(&camera.model))
    return {lens->k1, lens->k2, lens->k3, lens->k4};
  const auto& lens = std::get<PinholeLens>(camera.model);
  return {lens.k1, lens.k2, lens.p1, lens.p2, lens.k3};
}

std::vector<double> matrix(const CameraSettings& c) {
  return {c.fu_px, 0, c.u0_px, 0, c.fv_px, c.v0_px, 0, 0, 1};
}

std::string kalibr_text(const CameraSettings& c) {
  std::vector<double> distortion = coefficients(c);
  distortion.resize(4);  // k3 of a pinhole is 0
  return fmt::format(
      "cam0:\n  camera_model: pinhole\n  intrinsics: {}\n  distortion_model: {}\n  distortion_coeffs: {}\n  resolution: [{}, {}]\n"
      "  cam_overlaps: []\n  rostopic: /cam0/image_raw\n",
      yaml_list({c.fu_px, c.fv_px, c.u0_px, c.v0_px}), has_fisheye(c) ? "equidistant" : "radtan",
      yaml_list(distortion), c.width_px, c.height_px);
}

std::string ros_text(const CameraSettings& c) {
  const auto section = [](const char* key, int rows, int cols, const std::vector<double>& data) {
    return fmt::format("{}:\n  rows: {}\n  cols: {}\n  data: {}\n", key, rows, cols, yaml_list(data));
  };
  const std::vector<double> distortion = coefficients(c);
  return fmt::format("image_width: {}\nimage_height: {}\ncamera_name: camera\n", c.width_px, c.height_px) +
         section("camera_matrix", 3, 3, matrix(c)) +
         fmt::format("distortion_model: {}\n", has_fisheye(c) ? "equidistant" : "plumb_bob") +
         section("distortion_coefficients", 1, static_cast<int>(distortion.size()), distortion) +
         section("rectification_matrix", 3, 3, {1, 0, 0, 0, 1, 0, 0, 0, 1}) +
         section("projection_matrix", 3, 4, {c.fu_px, 0, c.u0_px, 0, 0, c.fv_px, c.v0_px, 0, 0, 0, 1, 0});
}

std::string opencv_text(const CameraSettings& c, const std::string& comment) {
  const auto section = [](const char* key, std::size_t rows, int cols, const std::vector<double>& data) {
    return fmt::format("{}: !!opencv-matrix\n   rows: {}\n   cols: {}\n   dt: d\n   data: {}\n", key, rows,
                       cols, yaml_list(data));
  };
  const std::vector<double> distortion = coefficients(c);
  return "%YAML:1.0\n---\n" + commented(comment) +
         fmt::format("image_width: {}\nimage_height: {}\nfisheye_model: {}\n", c.width_px, c.height_px,
                     has_fisheye(c) ? 1 : 0) +
         section("camera_matrix", 3, 3, matrix(c)) +
         section("distortion_coefficients", distortion.size(), 1, distortion);
}

std::string toml_text(const CameraSettings& camera) {
  const GivenValues nothing;
  SettingReader reader(nothing);
  CameraSettings copy = camera;
  read_camera(reader, copy);
  std::string text = "[camera]\n";
  for (const SettingInForce& setting : reader.settings())
    text += fmt::format("{} = {}\n", setting.key.substr(std::string("camera.").size()), setting.value);
  return text;
}

}  // namespace

std::optional<CalibrationFormat> written_format(const std::string& word) {
  if (word == "kalibr") return CalibrationFormat::kalibr;
  if (word == "ros") return CalibrationFormat::ros;
  if (word == "opencv") return CalibrationFormat::opencv;
  if (word == "incognita") return CalibrationFormat::incognita;
  return std::nullopt;
}

std::optional<CalibrationFormat> guess_written_format(const std::filesystem::path& file) {
  const std::string ending = file.extension().string();
  if (ending == ".toml") return CalibrationFormat::incognita;
  if (ending != ".yaml" && ending != ".yml") return std::nullopt;
  std::string name = file.stem().string();
  for (char& c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  const auto has = [&](const char* word) { return name.find(word) != std::string::npos; };
  if (has("camchain") || has("kalibr")) return CalibrationFormat::kalibr;
  if (has("camera_info") || has("ros")) return CalibrationFormat::ros;
  return CalibrationFormat::opencv;
}

std::string why_not_held(const CameraSettings& camera, CalibrationFormat format) {
  if (format == CalibrationFormat::incognita) return "";
  if (std::holds_alternative<WideAngleLens>(camera.model))
    return fmt::format("{} has no model `wide-angle` (kd1_per_px2); a .toml file of incognita holds it",
                       name_of(format));
  const auto* lens = std::get_if<PinholeLens>(&camera.model);
  if (format == CalibrationFormat::kalibr && lens && lens->k3 != 0)
    return fmt::format("{} has no third radial term, and k3 = {}; ROS, OpenCV and .toml files hold it",
                       name_of(format), lens->k3);
  return "";
}

std::string calibration_text(const CameraSettings& camera, CalibrationFormat format,
                             const std::string& comment) {
  if (const std::string why = why_not_held(camera, format); !why.empty()) throw InputError(why);
  switch (format) {
    case CalibrationFormat::kalibr:
      return commented(comment) + kalibr_text(camera);
    case CalibrationFormat::ros:
      return commented(comment) + ros_text(camera);
    case CalibrationFormat::opencv:
      return opencv_text(camera, comment);
    case CalibrationFormat::incognita:
      return commented(comment) + toml_text(camera);
    default:
      throw InputError(
          fmt::format("{} is read only; write kalibr, ros, opencv or incognita", name_of(format)));
  }
}

}  // namespace incognita
