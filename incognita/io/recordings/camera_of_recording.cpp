#include "incognita/io/recordings/camera_of_recording.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "incognita/io/formats/data_folder.hpp"
#include "incognita/io/formats/files.hpp"
#include "incognita/io/recordings/recording_formats.hpp"
#include "incognita/messages/errors.hpp"

namespace incognita {
namespace {

/// Prefix of the sources of settings that follow another value.
const std::string taken = "as ";

/// A number, or nothing for a text.
std::optional<double> number_of(const std::string& written) {
  const TomlValue value = value_of_toml(written);
  if (const auto* whole = std::get_if<std::int64_t>(&value.value)) return static_cast<double>(*whole);
  if (const auto* number = std::get_if<double>(&value.value)) return *number;
  return std::nullopt;
}

/// Rounding within this tolerance moves no image point by half a pixel.
bool agree(const std::string& written, const std::string& calibrated) {
  const auto a = number_of(written), b = number_of(calibrated);
  if (!a || !b) return written == calibrated;
  return std::abs(*a - *b) <= 1e-3 * std::max(1.0, std::abs(*b));
}

/// `path` is that of the recording. What is wrong with a bag is reported by its reader.
std::optional<CalibratedCamera> camera_in(const std::filesystem::path& path,
                                          const RecordingSettings& settings) {
  if (looks_like_euroc(path)) return camera_in_euroc(path);
  if (looks_like_kitti(path)) return camera_in_kitti(path);
  if (looks_like_bag(path)) try {
      return camera_in_bag(path, {settings.image_topic, settings.truth_topic});
    } catch (const InputError&) {
      return std::nullopt;
    }
  return std::nullopt;
}

}  // namespace

std::optional<FoundCamera> camera_of_recording(const Scenario& s, const std::filesystem::path& file) {
  using Format = RecordingSettings::Format;
  const Format format = s.recording.format;
  if (format != Format::automatic && format != Format::euroc && format != Format::kitti &&
      format != Format::bag)
    return std::nullopt;
  std::filesystem::path folder;
  try {
    folder = find_data(s.recording.folder, file, "");
  } catch (const InputError&) {
    return std::nullopt;  // reported by the reader of the recording
  }
  const auto calibration = camera_in(folder, s.recording);
  if (!calibration) return std::nullopt;
  if (!calibration->unfit.empty())
    throw InputError(fmt::format(
        "{}: {}, which no camera model supports; undistort the images, and describe the resulting camera in [camera] with model = \"pinhole\"",
        shown(calibration->file), calibration->unfit));
  return FoundCamera{calibration->camera, taken + shown(calibration->file)};
}

std::string compare_camera(const LoadedScenario& loaded, const Recording& recording) {
  if (!recording.camera || !recording.camera->unfit.empty() || !loaded.scenario.recording.check_calibration)
    return "";
  const GivenValues nothing;
  SettingReader reader(nothing);
  CameraSettings calibrated = recording.camera->camera;
  read_camera(reader, calibrated);
  std::string differences;
  for (const SettingInForce& theirs : reader.settings())
    for (const SettingInForce& ours : loaded.settings)
      if (ours.key == theirs.key && !agree(ours.value, theirs.value))
        differences += fmt::format("{}: {} = {}: {} has {}\n", ours.source, ours.key, ours.value,
                                   shown(recording.camera->file), theirs.value);
  if (differences.empty())
    return fmt::format("the camera {} {}",
                       loaded.source_of("camera.model") == taken + shown(recording.camera->file)
                           ? "is taken from"
                           : "agrees with",
                       shown(recording.camera->file));
  throw InputError(
      differences +
      "Use the values of the calibration, or remove [camera] to take them from there. For a recalibrated camera set recording.check_calibration = false");
}

}  // namespace incognita
