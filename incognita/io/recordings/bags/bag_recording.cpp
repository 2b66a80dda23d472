#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "incognita/io/bags/bag.hpp"
#include "incognita/io/bags/bag_folder.hpp"
#include "incognita/io/recordings/bags/bag_camera.hpp"
#include "incognita/io/recordings/bags/bag_contents.hpp"
#include "incognita/io/recordings/bags/bag_images.hpp"
#include "incognita/io/recordings/bags/bag_topics.hpp"
#include "incognita/io/recordings/bags/bag_truth.hpp"
#include "incognita/io/recordings/recording_formats.hpp"
#include "incognita/messages/errors.hpp"

namespace incognita {
namespace {

/// When the images were taken, and where they lie in the bag.
struct BagFrames {
  std::vector<std::int64_t> times_ns;  ///< increasing
  std::vector<bags::BagMessage> messages;
  bool by_recorder = false;  ///< the images have no stamps
};

/// By the time that counts.
struct TimedImage {
  std::int64_t time_ns = 0;
  bags::BagMessage message;
};

/// The images in time order; of equal times the first, which is said.
BagFrames frames_of(std::vector<TimedImage> images, std::vector<std::string>& notes) {
  std::stable_sort(images.begin(), images.end(),
                   [](const TimedImage& a, const TimedImage& b) { return a.time_ns < b.time_ns; });
  constexpr std::int64_t finest_ns = 1000;  // stamps are rounded to whole microseconds
  BagFrames frames;
  for (const TimedImage& image : images) {
    if (!frames.times_ns.empty() && image.time_ns - frames.times_ns.back() < finest_ns) continue;
    frames.times_ns.push_back(image.time_ns);
    frames.messages.push_back(image.message);
  }
  if (const std::size_t repeated = images.size() - frames.times_ns.size(); repeated > 0)
    notes.push_back(fmt::format("{} images are not used: they have the time stamp of another", repeated));
  return frames;
}

BagFrames frames_in(const std::vector<BagContents::ImagePlace>& images, std::vector<std::string>& notes) {
  const bool by_recorder = std::all_of(images.begin(), images.end(),
                                       [](const auto& image) { return image.stamps.header_ns == 0; });
  const bool takes_zero = by_recorder || zero_is_a_time(images);
  std::vector<TimedImage> timed;
  for (const BagContents::ImagePlace& image : images)
    if (takes_zero || image.stamps.header_ns != 0)
      timed.push_back({by_recorder ? image.stamps.recorded_ns : image.stamps.header_ns, image.message});
  if (by_recorder)
    notes.push_back(
        "the images have no time stamps: they have the times of the recorder, and so has the truth");
  if (timed.size() < images.size())
    notes.push_back(
        fmt::format("{} images are not used: they have no time stamp", images.size() - timed.size()));
  BagFrames frames = frames_of(std::move(timed), notes);
  frames.by_recorder = by_recorder;
  return frames;
}

void note_camera_of_bag(const BagContents& contents, const ChosenTopics& topics, const std::string& path,
                        Recording& recording) {
  if (!topics.camera_info) {
    recording.notes.push_back(
        fmt::format("there is no CameraInfo beside {}: the camera is not compared", topics.images->name));
    return;
  }
  const std::string name = path + ": " + topics.camera_info->name;
  const bool is_rectified = has_rectified_images(topics.images->name);
  if (contents.camera_info) recording.camera = calibrated_camera(*contents.camera_info, is_rectified, name);
  if (!recording.camera)
    recording.notes.push_back(fmt::format("{}: has no calibration: the camera is not compared", name));
  else if (!recording.camera->unfit.empty())
    recording.notes.push_back(fmt::format(
        "{}: {}, which no camera model supports: the camera is not compared", name, recording.camera->unfit));
  if (contents.other_camera_infos > 0)
    recording.notes.push_back(
        fmt::format("{}: {} messages have another calibration than the first, which is used", name,
                    contents.other_camera_infos));
}

void note_damage(const bags::Bag& bag, const BagContents& contents, std::vector<std::string>& notes) {
  notes.insert(notes.end(), bag.damage().begin(), bag.damage().end());
  if (contents.unread > 0)
    notes.push_back(fmt::format("{} messages cannot be read and are not used, the first: {}", contents.unread,
                                contents.first_unread));
}

void note_frames_of_cameras(const BagContents& contents, std::vector<std::string>& notes) {
  const std::string& first = contents.images.front().frame;
  const auto others = std::count_if(contents.images.begin(), contents.images.end(),
                                    [&](const auto& image) { return image.frame != first; });
  if (others > 0)
    notes.push_back(fmt::format("{} of {} images are of another frame than `{}`, that of the first", others,
                                contents.images.size(), first));
}

}  // namespace

bool looks_like_bag(const std::filesystem::path& path) { return bags::is_bag(path); }

std::optional<CalibratedCamera> camera_in_bag(const std::filesystem::path& path, const BagTopics& wanted) {
  const bags::Bag bag(path);
  const ChosenTopics topics = choose_topics(bag, path.string(), wanted);
  if (!topics.camera_info) return std::nullopt;
  const auto info = first_camera_info(bag, *topics.camera_info);
  if (!info) return std::nullopt;
  return calibrated_camera(*info, has_rectified_images(topics.images->name),
                           path.string() + ": " + topics.camera_info->name);
}

Recording read_bag(const std::filesystem::path& path, const BagTopics& wanted) {
  const auto bag = std::make_shared<const bags::Bag>(path);
  const ChosenTopics topics = choose_topics(*bag, path.string(), wanted);
  BagContents contents = read_contents(*bag, topics);
  if (contents.images.empty())
    throw InputError(fmt::format("{}: no image of {} can be read: {}", path.string(), topics.images->name,
                                 contents.first_unread));
  Recording recording{"bag", path, {}, {}, topics.notes, {}};
  note_damage(*bag, contents, recording.notes);
  const BagFrames frames = frames_in(contents.images, recording.notes);
  for (const std::int64_t t : frames.times_ns) recording.frames.push_back({static_cast<double>(t) / 1e9, {}});
  recording.images = bag_images(bag, *topics.images, frames.messages);
  note_frames_of_cameras(contents, recording.notes);
  note_camera_of_bag(contents, topics, path.string(), recording);
  BagTruth truth = truth_of_bag(std::move(contents), topics, frames.times_ns, frames.by_recorder);
  recording.truth = std::move(truth.poses);
  recording.notes.insert(recording.notes.end(), truth.notes.begin(), truth.notes.end());
  return recording;
}

}  // namespace incognita
