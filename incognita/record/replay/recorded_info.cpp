#include "incognita/record/replay/recorded_info.hpp"

#include <nlohmann/json.hpp>
#include <optional>
#include <system_error>
#include <utility>

#include "incognita/io/bags/input_file.hpp"
#include "incognita/messages/errors.hpp"
#include "incognita/record/files/json_limits.hpp"

namespace incognita {
namespace {

using Json = nlohmann::ordered_json;

Json parse_object(const std::string& text, const std::string& place) {
  const auto wrong = [&](const std::string& why) {
    return InputError(place + ": damaged: " + why + "; repeat the run, or take another copy of it");
  };
  if (json_depth(text) > most_json_depth) throw wrong("nested too deep");
  try {
    Json json = Json::parse(text);
    if (!json.is_object()) throw wrong("not a JSON object");
    return json;
  } catch (const Json::exception& error) {
    throw wrong(brief(error));
  }
}

std::optional<std::string> text_of(const std::filesystem::path& path) {
  if (std::error_code ignored; !std::filesystem::exists(path, ignored)) return std::nullopt;
  const InputFile file(path);
  return file.read(0, file.size());
}

/// Of a file without /run: an earlier version.
void put_earlier(const std::filesystem::path& directory, const McapReader& log, const SnapshotScan& scan,
                 Json& info) {
  info["bodies"] = scan.bodies;
  if (const auto& transforms = log.messages("/tf"); !transforms.empty()) {
    const Json first = parse_object(log.text(transforms.front()), log.path().string() + ": /tf");
    const auto frame = first.find("child_frame_id");
    const bool camera = frame != first.end() && frame->is_string() &&
                        frame->get_ref<const std::string&>().find("camera") != std::string::npos;
    info["body"] = camera ? "camera" : "vehicle";
  }
  const double duration_s = scan.frames.back().t - scan.frames.front().t;
  if (duration_s > 0) info["rate_hz"] = static_cast<double>(scan.frames.size() - 1) / duration_s;
  const auto summary = text_of(directory / "summary.json");
  if (!summary) return;
  const Json known = parse_object(*summary, (directory / "summary.json").string());
  for (const char* key : {"version", "seed"})
    if (known.contains(key)) info[key] = known[key];
  if (const auto alignment = known.find("ate_alignment"); alignment != known.end()) {
    info["same_frame_as_truth"] = *alignment == "none";
    info["scale_known"] = *alignment != "sim3";
  }
}

}  // namespace

std::string recorded_info(const std::filesystem::path& directory, const std::string& name,
                          const McapReader& log, const SnapshotScan& scan) {
  Json info;
  info["name"] = name;
  if (const auto& runs = log.messages("/run"); !runs.empty()) {
    const Json run = parse_object(log.text(runs.front()), log.path().string() + ": /run");
    for (const auto& [key, value] : run.items()) info[key == "name" ? "scenario" : key] = value;
  } else {
    put_earlier(directory, log, scan, info);
  }
  info["expected_frames"] = scan.frames.size();
  if (auto settings = text_of(directory / "effective.toml")) info["effective_toml"] = *std::move(settings);
  Json& interventions = info["interventions"] = Json::array();
  for (const std::string& intervention : scan.interventions)
    interventions.push_back(Json::parse(intervention));
  for (const char* live_only : {"disturbances", "strategies", "gazes"}) info[live_only] = Json::array();
  info["manual"] = false;
  if (!scan.damage.empty()) info["damage"] = scan.damage;
  return info.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string recorded_summary(const std::filesystem::path& directory) {
  const std::filesystem::path path = directory / "summary.json";
  const auto text = text_of(path);
  if (!text)
    throw InputError(path.string() + ": no such file; name the folder that a run was written to (--out)");
  return parse_object(*text, path.string()).dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace incognita
