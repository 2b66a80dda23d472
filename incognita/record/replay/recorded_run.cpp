#include "incognita/record/replay/recorded_run.hpp"

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <system_error>

#include "incognita/messages/errors.hpp"
#include "incognita/record/files/image_text.hpp"
#include "incognita/record/replay/recorded_frame.hpp"
#include "incognita/record/replay/recorded_info.hpp"
#include "incognita/record/replay/recorded_series.hpp"

namespace incognita {
namespace fs = std::filesystem;
namespace {

fs::path log_in(const fs::path& path) {
  std::error_code ignored;
  if (fs::is_regular_file(path, ignored)) return path;
  if (fs::is_regular_file(path / "run.mcap", ignored)) return path / "run.mcap";
  throw InputError(path.string() +
                   (fs::is_directory(path, ignored) ? ": no run.mcap is in it" : ": no such folder") +
                   "; name the folder that a run was written to (--out)");
}

fs::path folder_of(const fs::path& log) { return fs::absolute(log).lexically_normal().parent_path(); }

std::string image_of_message(const std::string& text, const std::string& place) {
  try {
    const auto json = nlohmann::json::parse(text);
    if (auto bytes = from_base64(json.at("data").get_ref<const std::string&>())) return *std::move(bytes);
  } catch (const nlohmann::json::exception&) {
  }
  throw InputError(place + ": not an image; the file is damaged");
}

}  // namespace

RecordedRun::RecordedRun(const fs::path& path)
    : directory_(folder_of(log_in(path))),
      name_(directory_.filename().string()),
      log_(log_in(path)),
      scan_(scan_snapshots(log_)) {}

const bags::MessagePlace& RecordedRun::snapshot_at(std::int64_t frame) const {
  if (frame < 0 || frame >= frames())
    throw InputError(log_.path().string() + ": there is no frame " + std::to_string(frame) +
                     "; the frames are 0 to " + std::to_string(frames() - 1));
  return log_.messages(snapshot_topic)[static_cast<std::size_t>(frame)];
}

std::string RecordedRun::info_json() const { return recorded_info(directory_, name_, log_, scan_); }

std::string RecordedRun::series_json() const { return recorded_series(directory_, scan_); }

std::string RecordedRun::frame_json(std::int64_t frame) const {
  const std::string text = log_.text(snapshot_at(frame));
  const RecordedFrame& at = scan_.frames[static_cast<std::size_t>(frame)];
  const auto text_of = [&](const std::optional<std::size_t>& other) -> std::optional<std::string> {
    if (!other || *other == static_cast<std::size_t>(frame)) return std::nullopt;
    return log_.text(snapshot_at(static_cast<std::int64_t>(*other)));
  };
  RecordedFrameTexts texts{text, text_of(at.landmarks_at), std::nullopt, std::nullopt};
  if (at.explored_at != at.landmarks_at) texts.with_exploration = text_of(at.explored_at);
  if (frame + 1 == frames() && damage().empty()) texts.map_csv = directory_ / "map.csv";
  return complete_snapshot(texts, log_.path().string() + ": frame " + std::to_string(frame));
}

std::optional<std::string> RecordedRun::image(std::int64_t frame) const {
  const std::uint64_t until = snapshot_at(frame).offset;  // the image of a frame precedes its snapshot
  const auto& images = log_.messages("/camera/image");
  const auto after = std::partition_point(
      images.begin(), images.end(), [&](const bags::MessagePlace& image) { return image.offset < until; });
  if (after == images.begin()) return std::nullopt;
  const bags::MessagePlace& last = *std::prev(after);
  return image_of_message(log_.text(last), log_.path().string() + ": at byte " + std::to_string(last.offset));
}

std::string RecordedRun::summary_json() const { return recorded_summary(directory_); }

}  // namespace incognita
