#include "incognita/io/recordings/bags/bag_topics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>
#include <tuple>

#include "incognita/messages/errors.hpp"

namespace incognita {
namespace {

using bags::Bag;
using bags::BagTopic;
using Topics = std::vector<const BagTopic*>;

std::string lower_case(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

template <std::size_t n>
bool has_any(const std::string& text, const std::array<std::string_view, n>& words) {
  return std::any_of(words.begin(), words.end(),
                     [&](std::string_view word) { return text.find(word) != std::string::npos; });
}

bool is_read(const BagTopic& topic) { return topic.encoding == "cdr" || topic.encoding == "ros1"; }

bool is_image(const BagTopic& topic) {
  return is_read(topic) && (topic.type == "sensor_msgs/Image" || is_compressed_image(topic));
}

bool is_pose(const BagTopic& topic) {
  return is_read(topic) && (topic.type == "geometry_msgs/PoseStamped" ||
                            topic.type == "geometry_msgs/PoseWithCovarianceStamped" ||
                            topic.type == "geometry_msgs/TransformStamped" || is_odometry(topic));
}

/// Names that cameras with several outputs give to those that show no texture.
bool shows_depth(const BagTopic& topic) {
  static constexpr auto words = std::to_array<std::string_view>({"depth", "disparity", "confidence"});
  return has_any(lower_case(topic.name), words);
}

bool shows_color_or_gray(const BagTopic& topic) {
  static constexpr auto words =
      std::to_array<std::string_view>({"color", "colour", "rgb", "gray", "grey", "mono", "left"});
  return has_any(lower_case(topic.name), words);
}

/// Names of motion capture systems, and words for ground truth.
bool is_named_as_truth(const BagTopic& topic) {
  static constexpr auto words = std::to_array<std::string_view>(
      {"truth", "vicon", "mocap", "optitrack", "vrpn", "qualisys", "/gt/", "_gt/"});
  const std::string name = lower_case(topic.name);
  return has_any(name, words) || name.ends_with("/gt") || name.ends_with("_gt") || name.starts_with("/gt_");
}

Topics topics_that(const Bag& bag, bool (*fits)(const BagTopic&)) {
  Topics found;
  for (const auto& [name, topic] : bag.topics())
    if (fits(topic)) found.push_back(&topic);
  return found;
}

std::string described(const BagTopic& topic) {
  const std::string encoded = is_read(topic) ? "" : fmt::format(", encoded as `{:.20}`", topic.encoding);
  return fmt::format("{:.120} ({:.60}, {}{})", topic.name, topic.type, topic.messages.size(), encoded);
}

std::string list_of(const Topics& topics) {
  constexpr std::size_t most = 12;
  std::string text;
  for (std::size_t i = 0; i < std::min(topics.size(), most); ++i)
    text += (text.empty() ? "" : ", ") + described(*topics[i]);
  return topics.size() > most ? fmt::format("{}, and {} more", text, topics.size() - most) : text;
}

std::string all_topics(const Bag& bag) {
  return list_of(topics_that(bag, [](const BagTopic&) { return true; }));
}

/// The topic that the user named, with or without the slash before it.
const BagTopic* topic_named(const Bag& bag, const std::string& name) {
  for (const std::string& word : {name, "/" + name})
    if (const auto found = bag.topics().find(word); found != bag.topics().end()) return &found->second;
  return nullptr;
}

/// Larger is better: no depth, then the number of messages, then words in the name, then raw before compressed.
auto merit_of(const BagTopic& topic) {
  return std::tuple(!shows_depth(topic), topic.messages.size(), shows_color_or_gray(topic),
                    !is_compressed_image(topic));
}

const BagTopic* image_topic(const Bag& bag, const std::string& path, const std::string& wanted,
                            std::vector<std::string>& notes) {
  Topics candidates = topics_that(bag, is_image);
  if (!wanted.empty()) {
    const BagTopic* const named = topic_named(bag, wanted);
    if (named && is_image(*named)) return named;
    throw InputError(fmt::format("{}: recording.image_topic = \"{}\": {}; image topics: {}", path, wanted,
                                 named
                                     ? fmt::format("is {}, and no images that can be read", described(*named))
                                     : "there is no such topic",
                                 candidates.empty() ? "none" : list_of(candidates)));
  }
  if (candidates.empty())
    throw InputError(fmt::format(
        "{}: there are no images (sensor_msgs/Image or CompressedImage, in CDR or as in ROS 1); it has: {}",
        path, all_topics(bag)));
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const BagTopic* a, const BagTopic* b) { return merit_of(*a) > merit_of(*b); });
  const BagTopic* const best = candidates.front();
  candidates.erase(candidates.begin());
  notes.push_back(candidates.empty() ? fmt::format("images of {}, the only image topic", described(*best))
                                     : fmt::format("images of {}; recording.image_topic may name another: {}",
                                                   described(*best), list_of(candidates)));
  return best;
}

/// `/camera/image_raw` has `/camera/camera_info`.
const BagTopic* camera_info_of(const Bag& bag, const BagTopic& images) {
  std::string name = images.name;
  if (is_compressed_image(images) && name.ends_with("/compressed")) name.resize(name.rfind('/'));
  const std::size_t slash = name.rfind('/');
  const std::string sibling = (slash == std::string::npos ? "" : name.substr(0, slash)) + "/camera_info";
  const BagTopic* const info = topic_named(bag, sibling);
  return info && is_read(*info) && info->type == "sensor_msgs/CameraInfo" ? info : nullptr;
}

void choose_truth(const Bag& bag, const std::string& path, const std::string& wanted, ChosenTopics& chosen) {
  Topics poses = topics_that(bag, is_pose);
  if (!wanted.empty()) {
    const BagTopic* const named = topic_named(bag, wanted);
    chosen.transforms_named = named && is_transform(*named);
    if (chosen.transforms_named) return;
    if (named && is_pose(*named)) return void(chosen.truth = named);
    throw InputError(fmt::format("{}: recording.truth_topic = \"{}\": {}; topics of poses: {}", path, wanted,
                                 named
                                     ? fmt::format("is {}, and no poses that can be read", described(*named))
                                     : "there is no such topic",
                                 poses.empty() ? "none" : list_of(poses)));
  }
  std::stable_sort(poses.begin(), poses.end(), [](const BagTopic* a, const BagTopic* b) {
    return a->messages.size() > b->messages.size();
  });
  const auto best = std::find_if(poses.begin(), poses.end(), [](const BagTopic* topic) {
    return is_named_as_truth(*topic) && !is_odometry(*topic);
  });
  if (best != poses.end()) {
    chosen.truth = *best;
    poses.erase(best);
    chosen.notes.push_back(
        fmt::format("truth of {}, by its name{}", described(*chosen.truth),
                    poses.empty() ? "" : "; recording.truth_topic may name another: " + list_of(poses)));
  }
  chosen.other_poses = std::move(poses);
}

}  // namespace

bool is_odometry(const BagTopic& topic) { return topic.type == "nav_msgs/Odometry"; }

bool is_compressed_image(const BagTopic& topic) { return topic.type == "sensor_msgs/CompressedImage"; }

bool is_transform(const BagTopic& topic) {
  return is_read(topic) && (topic.type == "tf2_msgs/TFMessage" || topic.type == "tf/tfMessage");
}

bags::Serialization serialization_of(const BagTopic& topic) {
  return topic.encoding == "ros1" ? bags::Serialization::ros1 : bags::Serialization::cdr;
}

ChosenTopics choose_topics(const Bag& bag, const std::string& path, const BagTopics& wanted) {
  ChosenTopics chosen;
  chosen.images = image_topic(bag, path, wanted.images, chosen.notes);
  chosen.camera_info = camera_info_of(bag, *chosen.images);
  chosen.transforms = topics_that(bag, is_transform);
  choose_truth(bag, path, wanted.truth, chosen);
  return chosen;
}

}  // namespace incognita
