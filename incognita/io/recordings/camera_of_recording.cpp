#include "incognita/io/recordings/camera_of_recording.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <vector>

#include "incognita/io/formats/data_folder.hpp"
#include "incognita/io/formats/files.hpp"
#include "incognita/io/recordings/recording_formats.hpp"
#include "incognita/io/scenario/settings.hpp"
#include "incognita/messages/errors.hpp"

namespace incognita {
namespace {

/// Prefix of the sources of settings that follow another value.
const std::string taken = "as ";

bool is_of_camera(const Setting& setting) { return section_of(setting.key) == "camera"; }

/// The camera settings without those of the other lens model.
std::vector<Setting> camera_settings(Scenario& scenario) {
  std::vector<Setting> list = list_settings(scenario);
  std::erase_if(list, [](const Setting& s) { return !is_of_camera(s) || s.key == "camera.kd1_per_px2"; });
  return list;
}

bool sets_no_camera(const LoadedScenario& loaded) {
  return std::all_of(loaded.sources.begin(), loaded.sources.end(), [](const auto& source) {
    return section_of(source.first) != "camera" || source.second == "default";
  });
}

std::optional<CalibratedCamera> calibration_of(const LoadedScenario& loaded) {
  const Scenario& s = loaded.scenario;
  const std::string& format = s.recording.format;
  if (s.run.world != "recording" || s.run.sensor != "camera" || (format != "auto" && format != "euroc"))
    return std::nullopt;
  std::filesystem::path folder;
  try {
    folder = find_data(s.recording.folder, loaded.file, "");
  } catch (const InputError&) {
    return std::nullopt;  // reported by the reader of the recording
  }
  return looks_like_euroc(folder) ? camera_in_euroc(folder) : std::nullopt;
}

/// Rounding within this tolerance moves no image point by half a pixel.
bool agrees(double written, double calibrated) {
  return std::abs(written - calibrated) <= 1e-3 * std::max(1.0, std::abs(calibrated));
}

bool agree(const Setting& written, const Setting& calibrated) {
  if (const auto* text = std::get_if<std::string*>(&written.field))
    return **text == **std::get_if<std::string*>(&calibrated.field);
  if (const auto* number = std::get_if<int*>(&written.field))
    return **number == **std::get_if<int*>(&calibrated.field);
  return agrees(**std::get_if<double*>(&written.field), **std::get_if<double*>(&calibrated.field));
}

}  // namespace

void take_camera_of_recording(LoadedScenario& loaded) {
  if (!sets_no_camera(loaded)) return;
  const auto calibration = calibration_of(loaded);
  if (!calibration) return;
  if (!calibration->unfit.empty())
    throw InputError(fmt::format(
        "{}: {}, which no camera model supports; undistort the images, and describe the resulting camera in [camera] with model = \"pinhole\"",
        shown(calibration->file), calibration->unfit));
  loaded.scenario.camera = calibration->camera;
  for (const Setting& setting : camera_settings(loaded.scenario))
    loaded.sources[setting.key] = taken + shown(calibration->file);
}

std::string compare_camera(const LoadedScenario& loaded, const Recording& recording) {
  if (!recording.camera || !recording.camera->unfit.empty() || !loaded.scenario.recording.check_calibration)
    return "";
  Scenario written = loaded.scenario, calibrated = loaded.scenario;
  calibrated.camera = recording.camera->camera;
  const std::vector<Setting> ours = camera_settings(written), theirs = camera_settings(calibrated);
  std::string differences;
  for (std::size_t i = 0; i < ours.size(); ++i)
    if (!agree(ours[i], theirs[i]))
      differences += fmt::format("{}: {} = {}: {} has {}\n", loaded.sources.at(ours[i].key), ours[i].key,
                                 ours[i].written(), shown(recording.camera->file), theirs[i].written());
  if (differences.empty())
    return fmt::format("the camera {} {}",
                       loaded.sources.at("camera.model").starts_with(taken) ? "is taken from" : "agrees with",
                       shown(recording.camera->file));
  throw InputError(
      differences +
      "Use the values of the calibration, or remove [camera] to take them from there. For a recalibrated camera set recording.check_calibration = false");
}

}  // namespace incognita
