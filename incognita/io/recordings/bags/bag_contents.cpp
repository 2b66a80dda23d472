#include "incognita/io/recordings/bags/bag_contents.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <tuple>

#include "incognita/io/formats/reading_progress.hpp"

namespace incognita {
namespace {

using bags::BagMessage;
using bags::BagTopic;

struct Wanted {
  const BagTopic* topic;
  BagMessage message;
};

/// In the order of the files, whatever the order of recording.
std::vector<Wanted> in_file_order(const std::vector<const BagTopic*>& topics) {
  std::vector<Wanted> wanted;
  for (const BagTopic* topic : topics)
    for (const BagMessage& message : topic->messages) wanted.push_back({topic, message});
  const auto place = [](const Wanted& w) {
    return std::tuple(w.message.file, w.message.place.chunk, w.message.place.offset);
  };
  std::sort(wanted.begin(), wanted.end(),
            [&](const Wanted& a, const Wanted& b) { return place(a) < place(b); });
  return wanted;
}

BagStamps stamps_of(const bags::Header& header, const BagMessage& message) {
  return {header.stamp_ns, static_cast<std::int64_t>(message.place.time_ns)};
}

/// Only those numbers that calibrated_camera() reads.
bool same_camera(const bags::CameraInfoMessage& a, const bags::CameraInfoMessage& b) {
  return a.width == b.width && a.height == b.height && a.k == b.k && a.d == b.d && a.p == b.p &&
         a.distortion_model == b.distortion_model;
}

bags::PoseMessage pose_in(bags::MessageCursor& cursor, const BagTopic& topic) {
  if (is_odometry(topic)) return bags::read_odometry(cursor);
  if (topic.type == "geometry_msgs/TransformStamped") return bags::read_transform(cursor);
  return bags::read_pose(cursor);
}

class ContentsReader {
 public:
  ContentsReader(const bags::Bag& bag, const ChosenTopics& topics) : bag_(bag), topics_(topics) {}

  BagContents contents;

  void read(const Wanted& wanted) {
    constexpr std::uint64_t header_bytes = 1024;  // of an image only its header is read
    const bool is_image = wanted.topic == topics_.images;
    try {
      const std::string bytes = bag_.content(wanted.message, is_image ? header_bytes : bags::BagFile::whole);
      bags::MessageCursor cursor(bytes, serialization_of(*wanted.topic));
      add(wanted, cursor);
    } catch (const bags::MessageError& error) {
      note_unread(bag_.where(wanted.message) + ": " + wanted.topic->type + ": " + error.what());
    } catch (const std::runtime_error& error) {
      note_unread(error.what());
    }
  }

 private:
  void add(const Wanted& wanted, bags::MessageCursor& cursor) {
    if (wanted.topic == topics_.images) {
      const bags::Header header = bags::read_header(cursor);
      contents.images.push_back({stamps_of(header, wanted.message), header.frame, wanted.message});
    } else if (wanted.topic == topics_.camera_info) {
      const bags::CameraInfoMessage info = bags::read_camera_info(cursor);
      if (!contents.camera_info) contents.camera_info = info;
      if (!same_camera(info, *contents.camera_info)) ++contents.other_camera_infos;
    } else if (wanted.topic == topics_.truth) {
      const bags::PoseMessage pose = pose_in(cursor, *wanted.topic);
      contents.poses.push_back({stamps_of(pose.header, wanted.message), pose});
    } else {
      const bool is_static = wanted.topic->name.find("static") != std::string::npos;
      for (const bags::PoseMessage& transform : bags::read_transforms(cursor))
        contents.transforms.add(transform, stamps_of(transform.header, wanted.message), is_static);
    }
  }

  void note_unread(const std::string& why) {
    if (contents.unread++ == 0) contents.first_unread = why;
  }

  const bags::Bag& bag_;
  const ChosenTopics& topics_;
};

}  // namespace

BagContents read_contents(const bags::Bag& bag, const ChosenTopics& topics) {
  std::vector<const BagTopic*> wanted = topics.transforms;
  for (const BagTopic* topic : {topics.images, topics.camera_info, topics.truth})
    if (topic) wanted.push_back(topic);
  ContentsReader reader(bag, topics);
  const std::vector<Wanted> messages = in_file_order(wanted);
  ReportedReading reading(bag.path(), "messages", messages.size());
  for (std::size_t i = 0; i < messages.size(); ++i) {
    reader.read(messages[i]);
    reading.done(i + 1);
  }
  return std::move(reader.contents);
}

std::optional<bags::CameraInfoMessage> first_camera_info(const bags::Bag& bag, const BagTopic& topic) {
  constexpr std::size_t most_tries = 10;
  for (std::size_t i = 0; i < std::min(most_tries, topic.messages.size()); ++i) try {
      const std::string bytes = bag.content(topic.messages[i]);
      bags::MessageCursor cursor(bytes, serialization_of(topic));
      return bags::read_camera_info(cursor);
    } catch (const std::runtime_error&) {
      continue;  // read_contents() reports it
    }
  return std::nullopt;
}

}  // namespace incognita
