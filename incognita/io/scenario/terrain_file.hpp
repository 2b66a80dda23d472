// Builds the terrain of a scenario: a plane, waves, or a height map from an image.
#pragma once

#include "incognita/io/scenario/load_scenario.hpp"
#include "incognita/models/motion/terrain.hpp"

namespace incognita {

/// Throws InputError with file, key and remedy if the image is invalid, too small, or does not cover the
/// start positions.
Terrain terrain_of(const LoadedScenario& loaded);

}  // namespace incognita
