// The camera of a bag, from its sensor_msgs/CameraInfo.
#pragma once

#include <optional>
#include <string>

#include "incognita/io/bags/messages.hpp"
#include "incognita/io/recordings/euroc_camera.hpp"

namespace incognita {

/// `name` says where the message is from, for messages; `is_rectified`: the images are those that P describes, without distortion.
/// nullopt if the camera is not calibrated (K is 0).
std::optional<CalibratedCamera> calibrated_camera(const bags::CameraInfoMessage& info, bool is_rectified,
                                                  const std::string& name);

/// By its name, which image_proc fixes: `image_rect`, `image_rect_color`.
bool has_rectified_images(const std::string& topic);

}  // namespace incognita
