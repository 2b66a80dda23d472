// What a recording needs from the messages of a bag, read in one pass, so that each chunk is decompressed once.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "incognita/io/bags/bag.hpp"
#include "incognita/io/bags/messages.hpp"
#include "incognita/io/recordings/bags/bag_topics.hpp"
#include "incognita/io/recordings/bags/bag_transforms.hpp"

namespace incognita {

constexpr std::int64_t hour_ns = 3'600'000'000'000;

/// ROS writes a stamp of 0 where there is none. Where the clock began at 0, as that of a simulation, 0 is a time.
template <class Messages>
bool zero_is_a_time(const Messages& messages) {
  return std::any_of(messages.begin(), messages.end(), [](const auto& message) {
    return message.stamps.header_ns > 0 && message.stamps.header_ns < hour_ns;
  });
}

struct BagContents {
  struct ImagePlace {
    BagStamps stamps;
    std::string frame;  ///< of the camera
    bags::BagMessage message;
  };
  struct Pose {
    BagStamps stamps;
    bags::PoseMessage pose;
  };

  std::vector<ImagePlace> images;  ///< as they lie in the bag
  std::vector<Pose> poses;
  TransformTree transforms;                            ///< to be sorted
  std::optional<bags::CameraInfoMessage> camera_info;  ///< the first
  std::size_t other_camera_infos = 0;                  ///< that state another camera than the first
  std::size_t unread = 0;                              ///< messages that are damaged
  std::string first_unread;                            ///< file, byte and reason of the first of them
};

BagContents read_contents(const bags::Bag& bag, const ChosenTopics& topics);

/// The first message of a topic that can be read; nullopt if there is none.
std::optional<bags::CameraInfoMessage> first_camera_info(const bags::Bag& bag, const bags::BagTopic& topic);

}  // namespace incognita
