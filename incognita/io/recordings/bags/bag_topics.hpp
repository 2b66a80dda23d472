// Which topics of a bag a recording is made of.
#pragma once

#include <string>
#include <vector>

#include "incognita/io/bags/bag.hpp"
#include "incognita/io/bags/message_cursor.hpp"
#include "incognita/io/recordings/recording.hpp"

namespace incognita {

struct ChosenTopics {
  const bags::BagTopic* images = nullptr;       ///< never null
  const bags::BagTopic* camera_info = nullptr;  ///< null: the bag has none of this camera
  const bags::BagTopic* truth = nullptr;        ///< of poses; null: perhaps the transforms have it
  bool transforms_named = false;                ///< the user named the transforms as the truth
  std::vector<const bags::BagTopic*> transforms;
  std::vector<const bags::BagTopic*> other_poses;  ///< that the user could name as the truth
  std::vector<std::string> notes;
};

/// `path` begins the messages of errors. Throws InputError with the topics of the bag if it has no images or not those that
/// the user wants.
ChosenTopics choose_topics(const bags::Bag& bag, const std::string& path, const BagTopics& wanted);

bool is_odometry(const bags::BagTopic& topic);
bool is_compressed_image(const bags::BagTopic& topic);
bool is_transform(const bags::BagTopic& topic);

/// How the messages of a topic are serialized, which must be one of the two that are read.
bags::Serialization serialization_of(const bags::BagTopic& topic);

}  // namespace incognita
