// The ground of a scenario: a plane, waves, or a height map from an image.
#pragma once

#include "incognita/io/scenario/load_scenario.hpp"
#include "incognita/models/terrain.hpp"

namespace incognita {

/// Throws InputError with file, key and remedy where the image is none, is too small, or does not reach where
/// the vehicles start.
Terrain terrain_of(const LoadedScenario& loaded);

}  // namespace incognita
