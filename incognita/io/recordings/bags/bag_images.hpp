// The images of a bag.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "incognita/io/bags/bag.hpp"
#include "incognita/io/bags/messages.hpp"
#include "incognita/io/recordings/indexed_images.hpp"

namespace incognita {

/// The image as 8-bit gray. Encodings of sensor_msgs/image_encodings.hpp: mono8, mono16 (the upper 8 bits), rgb8, bgr8, rgba8,
/// bgra8, 8UC1, 8UC3 and 8UC4 (as bgr), bayer_*8, yuv422 and uyvy, yuv422_yuy2 and yuyv. Throws std::runtime_error with
/// the reason for another encoding, for sizes that do not fit the data, and for sides above 16384 px.
Image gray_image(const bags::ImageMessage& message);

/// The same of a JPEG, a PNG, or what else read_image() decodes.
Image gray_image(const bags::CompressedImageMessage& message);

/// Image k is that of message k, one of `topic`. Errors name file and byte.
std::shared_ptr<IndexedImages> bag_images(std::shared_ptr<const bags::Bag> bag, const bags::BagTopic& topic,
                                          std::vector<bags::BagMessage> messages);

}  // namespace incognita
