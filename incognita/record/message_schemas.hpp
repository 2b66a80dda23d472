// What the messages of run.mcap look like, as JSON Schema.
#pragma once

#include <string>

namespace incognita {

/// Every field of a message is described, units included; those that may be missing are not in `required`.
/// Only what viewers understand is used: one type per field, objects and arrays spelt out where they stand.
/// The layout of foxglove.* is Foxglove's; a message has the part of it that is filled here.
namespace message_schemas {
std::string frame_transform();
std::string pose_in_frame();
std::string scene_update();
std::string compressed_image();
std::string image_annotations();
std::string snapshot();
}  // namespace message_schemas

}  // namespace incognita
