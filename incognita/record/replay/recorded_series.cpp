#include "incognita/record/replay/recorded_series.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>
#include <vector>

#include "incognita/messages/errors.hpp"
#include "incognita/record/files/csv_table.hpp"

namespace incognita {
namespace {

using Json = nlohmann::ordered_json;

/// An empty table if there is none, e.g. because only run.mcap was copied. Throws InputError if its times are not those of
/// the frames.
CsvTable table_of(const std::filesystem::path& path, const std::vector<RecordedFrame>& frames) {
  if (std::error_code ignored; !std::filesystem::exists(path, ignored)) return {};
  CsvTable table = read_csv(path);
  if (!table.find("t")) throw InputError(path.string() + ":1: no column `t`; not a table of a run");
  const std::vector<double> times = table.numbers("t");
  for (std::size_t i = 0; i < std::min(times.size(), frames.size()); ++i)
    if (times[i] != frames[i].t)
      throw InputError(
          fmt::format("{}:{}: t = {}, but frame {} of run.mcap is at t = {}; they are of different runs",
                      path.string(), i + 2, times[i], i, frames[i].t));
  return table;
}

/// One value per frame.
Json column_json(const CsvTable& table, const std::string& name, std::size_t frames) {
  const std::vector<double> values = table.numbers(name);
  Json list = Json::array();
  for (std::size_t i = 0; i < frames; ++i)
    list.push_back(i < values.size() && std::isfinite(values[i]) ? Json(values[i]) : Json());
  return list;
}

Json position(const std::optional<std::array<double, 3>>& known) {
  return known ? Json(*known) : Json(nullptr);
}

/// Per body {"estimate": [[x, y, z] or null, ...], "truth": [...]}, one entry per frame.
Json paths_of(const SnapshotScan& scan) {
  Json paths = Json::array();
  for (std::size_t i = 0; i < static_cast<std::size_t>(scan.bodies); ++i) {
    Json estimate = Json::array(), truth = Json::array();
    for (const RecordedFrame& frame : scan.frames) {
      const RecordedPosition at = i < frame.bodies.size() ? frame.bodies[i] : RecordedPosition{};
      estimate.push_back(position(at.estimate)), truth.push_back(position(at.truth));
    }
    paths.push_back({{"estimate", std::move(estimate)}, {"truth", std::move(truth)}});
  }
  return paths;
}

}  // namespace

std::string recorded_series(const std::filesystem::path& directory, const SnapshotScan& scan) {
  const std::size_t frames = scan.frames.size();
  Json json;
  json["frames"] = frames;
  json["first_frame"] = 0;
  for (const RecordedFrame& frame : scan.frames) {
    json["t"].push_back(frame.t);
    json["state"].push_back(frame.state);
  }
  Json& columns = json["columns"] = Json::object();
  const CsvTable series = table_of(directory / "series.csv", scan.frames);
  for (const std::string& name : series.columns)
    if (name != "t" && name != "state") columns[name] = column_json(series, name, frames);
  Json& timing = json["timing_ms"] = Json::object();
  const CsvTable timings = table_of(directory / "timings.csv", scan.frames);
  for (const std::string& name : timings.columns)
    if (name.ends_with("_ms")) timing[name.substr(0, name.size() - 3)] = column_json(timings, name, frames);
  json["paths"] = paths_of(scan);
  Json& events = json["events"] = Json::array();
  for (const RecordedEvent& event : scan.events)
    events.push_back({{"frame", event.frame}, {"t", event.t}, {"kind", event.kind}, {"text", event.text}});
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace incognita
