// The camera of a scenario and the calibration that its recording brings along.
#pragma once

#include "incognita/io/recordings/recording.hpp"

namespace incognita {

/// Where the scenario follows a recording that has its calibration, and sets nothing of its camera, that
/// camera is taken; `sources` then names the file. A recording that is not there is left to whoever reads it.
void take_camera_of_recording(LoadedScenario& loaded);

/// Throws InputError with each setting that says something else than the calibration, both values, and what
/// to do; unless recording.check_calibration is false. Says that they agree, or that the one is taken from
/// the other; nothing where there is nothing to compare.
std::string compare_camera(const LoadedScenario& loaded, const Recording& recording);

}  // namespace incognita
