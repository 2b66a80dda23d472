// Settings that follow from the image and from the size of the map.
#pragma once

#include "incognita/models/sensors/camera.hpp"
#include "incognita/slam/features/settings.hpp"

namespace incognita {

/// The settings with values in place of zeros that mean "automatic", for images of this camera.
CameraSlamSettings with_automatic(CameraSlamSettings settings, const Camera& camera);

/// Features that are searched for in a frame at most, of settings without "automatic" values; the time budget may allow fewer.
int most_searched(const CameraSlamSettings& settings);

/// Landmarks in view in nine of ten frames at most, of the same settings: more than are searched for where MapSettings::max_gap_m
/// fills the gaps between them.
int most_in_view(const CameraSlamSettings& settings, const Camera& camera);

/// Number of features whose search and correction fit into SearchSettings::budget_ms, at least 10, by a model of the time and
/// not by a clock, so that the same images give the same estimate. `errors`: size of the state.
int affordable_measurements(const SearchSettings& settings, int errors);

}  // namespace incognita
