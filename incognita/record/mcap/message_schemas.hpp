// JSON Schemas of the messages in run.mcap.
#pragma once

#include <string>

namespace incognita {

/// Every field is described with its unit; optional fields are not in `required`. The schemas use only what
/// viewers support: one type per field, objects and arrays written inline. The foxglove.* layouts are
/// Foxglove's and include every required list, even if it is always empty.
namespace message_schemas {
/// Lists of a foxglove.SceneUpdate entity that stay empty here.
inline constexpr const char* unused_in_scenes[] = {"metadata", "arrows",    "cubes", "cylinders",
                                                   "lines",    "triangles", "texts", "models"};

std::string frame_transform();
std::string pose_in_frame();
std::string scene_update();
std::string compressed_image();
std::string image_annotations();
std::string run();
std::string snapshot();
}  // namespace message_schemas

}  // namespace incognita
