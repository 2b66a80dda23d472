#include "incognita/io/recordings/range_recording.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <system_error>
#include <vector>

#include "incognita/io/formats/data_folder.hpp"
#include "incognita/io/recordings/range_formats.hpp"
#include "incognita/io/scenario/enum_words.hpp"
#include "incognita/messages/errors.hpp"

namespace incognita {
namespace {

std::vector<std::string> folders_in(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (std::filesystem::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    std::error_code ignored;
    if (it->is_directory(ignored)) names.push_back(it->path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::string guess_range_format(const std::filesystem::path& folder) {
  if (looks_like_range_tables(folder)) return "tables";
  if (looks_like_acfr(folder)) return "acfr";
  if (looks_like_mrclam(folder)) return "mrclam";
  const std::vector<std::string> inside = folders_in(folder);
  throw InputError(
      fmt::format("{}: no range-bearing recording is recognized{}.\n"
                  "tables: odometry.csv and detections.csv; acfr: data_set.mat; mrclam: Barcodes.dat and, "
                  "for each robot N,\n"
                  "RobotN_Odometry.dat and RobotN_Measurement.dat. See docs/range-recordings.md.",
                  folder.string(),
                  inside.empty() ? "" : fmt::format("; it has the folders {}", fmt::join(inside, ", "))));
}

std::filesystem::path folder_of(const LoadedScenario& loaded) {
  return find_data(loaded.scenario.recording.folder, loaded.file,
                   loaded.source_of("recording.folder") + ": recording.folder");
}

std::string one_vehicle(const std::filesystem::path& folder, const std::string& format) {
  return fmt::format("{} has the format `{}`, a recording of one vehicle; only `mrclam` numbers its robots",
                     folder.string(), format);
}

RangeRecording read_as(const std::string& format, const std::filesystem::path& folder, int robot) {
  if (format == "acfr") return read_acfr(folder);
  if (format == "mrclam") return read_mrclam(folder, robot);
  if (format == "tables") return read_range_tables(folder);
  throw InputError(
      fmt::format("recording.format = {}: must be `auto`, `acfr`, `mrclam` or `tables`", format));
}

}  // namespace

RangeRecording read_range_recording(const std::filesystem::path& folder, const std::string& format,
                                    int robot) {
  std::error_code ignored;
  if (!std::filesystem::is_directory(folder, ignored)) {
    throw InputError(fmt::format("{}: is not a folder; a recording must be a folder", folder.string()));
  }
  if (format != "auto") return read_as(format, folder, robot);
  const std::string guess = guess_range_format(folder);
  RangeRecording recording = read_as(guess, folder, robot);
  recording.notes.insert(recording.notes.begin(),
                         fmt::format("{}: detected format `{}`", folder.string(), guess));
  return recording;
}

RangeRecording read_range_recording(const LoadedScenario& loaded) {
  const RecordingSettings& settings = loaded.scenario.recording;
  const std::filesystem::path folder = folder_of(loaded);
  RangeRecording recording = read_range_recording(folder, word_of(settings.format), settings.robot);
  if (settings.robot != 1 && recording.format != "mrclam")
    throw InputError(fmt::format("{}: recording.robot = {}: {}; remove recording.robot",
                                 loaded.source_of("recording.robot"), settings.robot,
                                 one_vehicle(folder, recording.format)));
  return recording;
}

std::vector<RangeRecording> read_team_recording(const LoadedScenario& loaded) {
  const std::filesystem::path folder = folder_of(loaded);
  if (loaded.scenario.recording.format == RecordingSettings::Format::automatic)
    if (const std::string format = guess_range_format(folder); format != "mrclam")
      throw InputError(fmt::format("{}: recording.team = true: {}; take recording.team = false",
                                   loaded.source_of("recording.team"), one_vehicle(folder, format)));
  return read_mrclam_team(folder);
}

}  // namespace incognita
