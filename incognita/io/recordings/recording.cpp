#include "incognita/io/recordings/recording.hpp"

#include <fmt/format.h>

#include <system_error>

#include "incognita/io/formats/data_folder.hpp"
#include "incognita/io/recordings/recording_formats.hpp"
#include "incognita/io/scenario/enum_words.hpp"
#include "incognita/messages/errors.hpp"
#include "incognita/messages/tick.hpp"

namespace incognita {
namespace {

std::string guess_format(const std::filesystem::path& folder) {
  if (looks_like_tum(folder)) return "tum";
  if (looks_like_euroc(folder)) return "euroc";
  return "images";
}

Recording read_as(const std::string& format, const std::filesystem::path& folder, double rate_hz,
                  const std::string& pattern) {
  if (format != "images" && !pattern.empty())
    throw InputError(fmt::format(
        "recording.pattern = \"{}\": does not apply to the format `{}`, whose tables list the images",
        pattern, format));
  if (format == "tum") return read_tum(folder);
  if (format == "euroc") return read_euroc(folder);
  if (format == "images") return read_image_folder(folder, rate_hz, pattern);
  throw InputError(fmt::format("recording.format = {}: must be `auto`, `images`, `tum` or `euroc`", format));
}

}  // namespace

Recording read_recording(const std::filesystem::path& folder, const std::string& format, double rate_hz,
                         const std::string& pattern) {
  std::error_code ignored;
  if (!std::filesystem::is_directory(folder, ignored)) {
    throw InputError(fmt::format("{}: is not a folder; a recording must be a folder", folder.string()));
  }
  if (format != "auto") return read_as(format, folder, rate_hz, pattern);
  const std::string guess = guess_format(folder);
  Recording recording = read_as(guess, folder, rate_hz, pattern);
  recording.notes.insert(recording.notes.begin(),
                         fmt::format("{}: detected format `{}`", folder.string(), guess));
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
  return read_recording(find_data(settings.folder, loaded.file, wanted_by), word_of(settings.format),
                        loaded.scenario.run.rate_hz, settings.pattern);
}

}  // namespace incognita
