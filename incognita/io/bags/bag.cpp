#include "incognita/io/bags/bag.hpp"

#include <algorithm>

#include "incognita/io/bags/bag_folder.hpp"
#include "incognita/messages/errors.hpp"

namespace incognita::bags {
namespace {

/// ROS 2 writes `sensor_msgs/msg/Image`.
std::string type_as_in_ros1(std::string type) {
  const std::string folder = "/msg/";
  if (const std::size_t at = type.find(folder); at != std::string::npos) type.replace(at, folder.size(), "/");
  return type;
}

}  // namespace

Bag::Bag(const std::filesystem::path& path) : path_(path) {
  BagFolder folder = files_of_bag(path);
  damage_ = std::move(folder.missing);
  std::string why;
  for (const std::filesystem::path& file : folder.files) try {
      add(file);
    } catch (const InputError& error) {
      if (folder.files.size() == 1) throw;
      why = error.what();
      damage_.push_back(why);
    }
  if (files_.empty()) throw InputError(why);
  for (auto& [name, topic] : topics_)
    std::stable_sort(
        topic.messages.begin(), topic.messages.end(),
        [](const BagMessage& a, const BagMessage& b) { return a.place.time_ns < b.place.time_ns; });
}

void Bag::add(const std::filesystem::path& path) {
  auto file = std::make_unique<BagFile>(path);
  const auto number = static_cast<std::uint32_t>(files_.size());
  for (const auto& [channel, places] : file->index().messages) {
    const BagChannel& from = file->index().channels.at(channel);
    BagTopic& topic = topics_[from.topic];  // several channels may have one topic: several nodes published it
    if (topic.messages.empty()) topic = {from.topic, type_as_in_ros1(from.type), from.encoding, {}};
    if (topic.type != type_as_in_ros1(from.type) || topic.encoding != from.encoding) {
      damage_.push_back(path.string() + ": at byte " + std::to_string(from.record) + ": `" + from.topic +
                        "` has messages of " + topic.type + " and of " + from.type +
                        "; the latter are not read");
      continue;
    }
    for (const MessagePlace& place : places) topic.messages.push_back({number, place});
  }
  if (!file->index().damage.empty())
    damage_.push_back(file->index().damage + "; what comes before it is used");
  files_.push_back(std::move(file));
}

std::string Bag::content(const BagMessage& message, std::uint64_t most) const {
  return files_.at(message.file)->message(message.place, most);
}

std::string Bag::where(const BagMessage& message) const {
  return files_.at(message.file)->where(message.place);
}

}  // namespace incognita::bags
