// What the messages of run.mcap look like, as JSON Schema.
#pragma once

#include <string>

namespace incognita {

/// Every field of a message is described, units included; those that may be missing are not in `required`.
/// Only what viewers understand is used: one type per field, objects and arrays spelt out where they stand.
/// The layout of foxglove.* is Foxglove's: every list that it demands is there, though it be empty.
namespace message_schemas {
/// Lists of an entity of foxglove.SceneUpdate that stay empty here.
inline constexpr const char* unused_in_scenes[] = {"metadata", "arrows",    "cubes", "cylinders",
                                                   "lines",    "triangles", "texts", "models"};

std::string frame_transform();
std::string pose_in_frame();
std::string scene_update();
std::string compressed_image();
std::string image_annotations();
std::string snapshot();
}  // namespace message_schemas

}  // namespace incognita
