#include "incognita/io/recordings/recording.hpp"

#include <fmt/format.h>

#include <system_error>
#include <utility>

#include "incognita/io/formats/data_folder.hpp"
#include "incognita/io/formats/files.hpp"
#include "incognita/io/recordings/recording_formats.hpp"
#include "incognita/io/recordings/true_poses.hpp"
#include "incognita/io/recordings/video.hpp"
#include "incognita/io/scenario/enum_words.hpp"
#include "incognita/messages/errors.hpp"
#include "incognita/messages/tick.hpp"

namespace incognita {
namespace {

std::string guess_format(const std::filesystem::path& path) {
  if (looks_like_video(path)) return "video";
  if (looks_like_tum(path)) return "tum";
  if (looks_like_euroc(path)) return "euroc";
  if (looks_like_kitti(path)) return "kitti";
  if (looks_like_bag(path)) return "bag";  // last: a folder of images may have the run.mcap of a run in it
  return "images";
}

Recording read_as(const std::string& format, const std::filesystem::path& path, double rate_hz,
                  const std::string& pattern, const BagTopics& topics) {
  if (format != "images" && !pattern.empty())
    throw InputError(fmt::format(
        "recording.pattern = \"{}\": does not apply to the format `{}`, which tells what its images are",
        pattern, format));
  if (format != "bag" && !(topics.images.empty() && topics.truth.empty()))
    throw InputError(fmt::format(
        "recording.image_topic and recording.truth_topic do not apply to the format `{}`, which has no topics",
        format));
  if (format == "bag") return read_bag(path, topics);
  if (format == "tum") return read_tum(path);
  if (format == "euroc") return read_euroc(path);
  if (format == "kitti") return read_kitti(path);
  if (format == "video") return read_video(path);
  if (format == "images") return read_image_folder(path, rate_hz, pattern);
  throw InputError(fmt::format(
      "recording.format = {}: must be `auto`, `images`, `tum`, `euroc`, `kitti`, `video` or `bag`", format));
}

Recording with_images(Recording recording) {
  if (recording.images) return recording;
  std::vector<std::filesystem::path> files;
  for (const Recording::RecordedFrame& frame : recording.frames) files.push_back(frame.image);
  recording.images = image_files(std::move(files));
  return recording;
}

bool names_folder(const std::filesystem::path& path) {
  std::error_code ignored;
  return std::filesystem::is_directory(path, ignored);
}

/// Beside the images of the recording, else under the data folder.
std::filesystem::path find_truth(const Recording& recording, const LoadedScenario& loaded) {
  const std::string& name = loaded.scenario.recording.truth;
  const std::filesystem::path folder =
      names_folder(recording.folder) ? recording.folder : recording.folder.parent_path();
  if (std::filesystem::exists(folder / name)) return folder / name;
  return find_data(name, loaded.file, loaded.source_of("recording.truth") + ": recording.truth");
}

void put_truth(const LoadedScenario& loaded, Recording& recording) {
  const RecordingSettings& settings = loaded.scenario.recording;
  if (!settings.truth.empty()) {
    const std::filesystem::path path = find_truth(recording, loaded);
    recording.truth = read_true_poses(path, recording.frames);
    recording.notes.push_back(
        fmt::format("{} true poses from {}, by recording.truth", recording.truth.size(), shown(path)));
  }
  for (RecordedPose& pose : recording.truth) pose.t += settings.truth_offset_s;
}

}  // namespace

Recording read_recording(const std::filesystem::path& path, const std::string& format, double rate_hz,
                         const std::string& pattern, const BagTopics& topics) {
  const bool may_be_file =
      format == "video" || format == "bag" || looks_like_video(path) || looks_like_bag(path);
  if (!may_be_file && !names_folder(path)) {
    throw InputError(
        fmt::format("{}: is not a folder; a recording must be a folder, a video or a bag", path.string()));
  }
  if (format != "auto") return with_images(read_as(format, path, rate_hz, pattern, topics));
  const std::string guess = guess_format(path);
  Recording recording = with_images(read_as(guess, path, rate_hz, pattern, topics));
  recording.notes.insert(recording.notes.begin(),
                         fmt::format("{}: detected format `{}`", path.string(), guess));
  return recording;
}

Recording with_rounded_stamps(Recording recording) {
  if (recording.format == "images") return recording;
  for (Recording::RecordedFrame& frame : recording.frames) frame.t = rounded_to_us(frame.t);
  for (RecordedPose& pose : recording.truth) pose.t = rounded_to_us(pose.t);
  recording.whole_us = true;
  return recording;
}

Recording read_recording(const LoadedScenario& loaded) {
  const RecordingSettings& settings = loaded.scenario.recording;
  const std::string wanted_by = loaded.source_of("recording.folder") + ": recording.folder";
  Recording recording = read_recording(find_data(settings.folder, loaded.file, wanted_by),
                                       word_of(settings.format), loaded.scenario.run.rate_hz,
                                       settings.pattern, {settings.image_topic, settings.truth_topic});
  put_truth(loaded, recording);
  return recording;
}

}  // namespace incognita
