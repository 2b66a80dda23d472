// Compares the camera of a scenario with the calibration of its recording, or takes it from there.
#pragma once

#include <filesystem>
#include <optional>

#include "incognita/io/recordings/recording.hpp"
#include "incognita/io/scenario/scenario_tree.hpp"

namespace incognita {

/// The camera in the calibration of the recording, if it contains one. `file`: that of the scenario. Throws InputError
/// if no camera model fits. A missing recording is not reported here but by its reader.
std::optional<FoundCamera> camera_of_recording(const Scenario& scenario, const std::filesystem::path& file);

/// Throws InputError with each setting that differs from the calibration, both values and the remedy, unless
/// recording.check_calibration is false. Returns a note that they agree or that one was taken from the other;
/// empty if there is no calibration.
std::string compare_camera(const LoadedScenario& loaded, const Recording& recording);

}  // namespace incognita
