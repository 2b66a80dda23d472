#include "incognita/io/calibrations/read_calibration.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <type_traits>

#include "incognita/io/calibrations/calibration_readers.hpp"
#include "incognita/io/formats/files.hpp"
#include "incognita/io/scenario/camera.hpp"
#include "incognita/messages/errors.hpp"
#include "incognita/messages/unfit_setting.hpp"

namespace incognita {
namespace {

constexpr const char* known_formats =
    "Kalibr's camchain.yaml, ROS camera_info, OpenCV's FileStorage (YAML, XML, JSON), EuRoC's sensor.yaml, KITTI's calib.txt, "
    "lines like `fx 420.5`, and [camera] of a scenario (.toml)";

CalibrationFile read_yaml(const YamlMap& map, const std::filesystem::path& file,
                          const CalibrationRequest& request) {
  if (is_kalibr(map)) return read_kalibr(map, file, request);
  if (is_euroc(map)) return read_euroc(map, file);
  if (is_ros(map)) return read_ros(map, file, request);
  if (is_opencv(map)) return read_opencv(map, file, request);
  throw InputError(
      fmt::format("{}: has none of the keys of a calibration; known are {}", shown(file), known_formats));
}

CalibrationFile read_any(const std::filesystem::path& file, const CalibrationRequest& request) {
  const std::string text = read_file(file, largest_calibration);
  if (file.extension() == ".toml") return read_camera_table(text, file);
  const std::size_t first = text.find_first_not_of(" \t\r\n\xef\xbb\xbf");
  if (first == std::string::npos) throw InputError(shown(file) + ": is empty");
  if (text[first] == '<') return read_yaml(YamlMap(file, opencv_xml_as_yaml(file, text)), file, request);
  if (is_kitti(text)) return read_kitti(text, file, request);
  if (is_plain(text)) return read_plain(text, file, request);
  return read_yaml(YamlMap(file, text), file, request);
}

/// The readers of files with several cameras choose one, or refuse a name that is none of them.
void refuse_camera_of_one(const CalibrationFile& found, const CalibrationRequest& request) {
  const bool has_names =
      found.format == CalibrationFormat::kalibr || found.format == CalibrationFormat::kitti;
  if (has_names || request.camera.empty()) return;
  throw InputError(fmt::format("{}: is read as {}, which has one camera: leave out --camera {}",
                               shown(found.calibrated.file), name_of(found.format),
                               request.camera.substr(0, 60)));
}

template <class Number>
void check_limits(const CalibratedCamera& calibrated, Number value, const char* key, const Limits& limits) {
  const double number = static_cast<double>(value);
  if (number >= limits.least && number <= limits.most && !(limits.more_than_least && number == limits.least))
    return;
  throw InputError(fmt::format("{}: camera.{} would be {}, and must be {} {} to {}", shown(calibrated.file),
                               key, value, limits.more_than_least ? "more than" : "from", limits.least,
                               limits.most));
}

}  // namespace

const char* name_of(CalibrationFormat format) {
  switch (format) {
    case CalibrationFormat::kalibr:
      return "Kalibr camchain";
    case CalibrationFormat::ros:
      return "ROS camera_info";
    case CalibrationFormat::opencv:
      return "OpenCV FileStorage";
    case CalibrationFormat::euroc:
      return "EuRoC sensor.yaml";
    case CalibrationFormat::kitti:
      return "KITTI calib.txt";
    case CalibrationFormat::plain:
      return "a key and its number per line";
    case CalibrationFormat::incognita:
      return "[camera] of a scenario";
  }
  return "";
}

CalibrationFile read_calibration_file(const std::filesystem::path& file, const CalibrationRequest& request) {
  const CalibrationFile found = read_any(file, request);
  refuse_camera_of_one(found, request);
  if (found.calibrated.unfit.empty()) check_size(found.calibrated.camera, file, request);
  return found;
}

void check_calibrated(const CalibratedCamera& calibrated) {
  if (!calibrated.unfit.empty())
    throw InputError(fmt::format(
        "{}: {}, which no camera model supports; undistort the images, and describe the resulting camera with model = \"pinhole\"",
        shown(calibrated.file), calibrated.unfit));
  CameraSettings::describe([&](auto member, const char* key, const char*, const Limits& limits, const char*) {
    const auto& value = calibrated.camera.*member;
    if constexpr (std::is_arithmetic_v<std::remove_cvref_t<decltype(value)>>)
      check_limits(calibrated, value, key, limits);
  });
  try {
    make_camera(calibrated.camera);
  } catch (const UnfitSetting& error) {
    throw InputError(fmt::format("{}: {} {}", shown(calibrated.file), error.keys.front(), error.what()));
  } catch (const std::invalid_argument& error) {
    throw InputError(fmt::format("{}: {}", shown(calibrated.file), error.what()));
  }
}

CameraSettings read_calibration(const std::filesystem::path& file, const CalibrationRequest& request) {
  const CalibrationFile read = read_calibration_file(file, request);
  check_calibrated(read.calibrated);
  return read.calibrated.camera;
}

}  // namespace incognita
