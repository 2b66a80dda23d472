// Compares the camera of a scenario with the calibration of its recording, or takes it from there.
#pragma once

#include "incognita/io/recordings/recording.hpp"

namespace incognita {

/// If the recording contains its calibration and the scenario sets no camera parameter, uses that camera and
/// sets `sources` to its file. A missing recording is not reported here but by its reader.
void take_camera_of_recording(LoadedScenario& loaded);

/// Throws InputError with each setting that differs from the calibration, both values and the remedy, unless
/// recording.check_calibration is false. Returns a note that they agree or that one was taken from the other;
/// empty if there is no calibration.
std::string compare_camera(const LoadedScenario& loaded, const Recording& recording);

}  // namespace incognita
