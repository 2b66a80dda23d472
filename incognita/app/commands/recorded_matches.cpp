#include "incognita/app/commands/recorded_matches.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "incognita/messages/errors.hpp"
#include "incognita/record/files/csv_table.hpp"
#include "incognita/record/files/tum.hpp"

namespace incognita {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t least_matches = 4;  // a view with fewer is not determined
constexpr double same_time_s = 1e-6;

struct RecordedMatch {
  std::size_t pose;  ///< in the trajectory
  std::int64_t id;
  Eigen::Vector2d pixel;
};

std::size_t column(const CsvTable& table, const fs::path& file, std::string_view name) {
  const auto found = table.find(name);
  if (!found) throw InputError(fmt::format("{}:1: there is no column `{}`", file.string(), name));
  return *found;
}

/// Throws for measurements of other bodies and sensors than the one camera.
void check_sensor(const CsvTable& table, const fs::path& file) {
  const std::size_t body = column(table, file, "body"), sensor = column(table, file, "sensor");
  for (std::size_t row = 0; row < table.rows.size(); ++row)
    if (table.rows[row][body] != "1" || table.rows[row][sensor] != "camera-1")
      throw InputError(fmt::format("{}:{}: body {}, {}: only a run of one camera can be adjusted",
                                   file.string(), row + 2, table.rows[row][body], table.rows[row][sensor]));
}

/// Of poses at known times; the estimate of other frames was not recorded. Rows are in the order of time.
std::vector<RecordedMatch> read_matched(const fs::path& file, const Trajectory& estimate) {
  const CsvTable table = read_csv(file);
  check_sensor(table, file);
  const std::size_t outcome = column(table, file, "outcome"), kind = column(table, file, "kind");
  const std::vector<double> t = table.numbers("t"), id = table.numbers("id"), u = table.numbers("measured_1"),
                            v = table.numbers("measured_2");
  std::vector<RecordedMatch> out;
  std::size_t pose = 0;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const std::vector<std::string>& cells = table.rows[row];
    if (cells[outcome] != "matched" || (cells[kind] != "landmark" && cells[kind] != "anchor")) continue;
    if (!std::isfinite(t[row]) || !std::isfinite(id[row]) || !std::isfinite(u[row]) || !std::isfinite(v[row]))
      throw InputError(
          fmt::format("{}:{}: t, id, measured_1 and measured_2 of a match must be finite numbers",
                      file.string(), row + 2));
    while (pose < estimate.size() && estimate[pose].t < t[row] - same_time_s) ++pose;
    if (pose == estimate.size()) break;
    if (estimate[pose].t > t[row] + same_time_s) continue;
    out.push_back({pose, static_cast<std::int64_t>(id[row]), {u[row], v[row]}});
  }
  return out;
}

/// Anchors have exact positions.
std::map<std::int64_t, Eigen::Vector3d> read_anchors(const fs::path& file) {
  const CsvTable table = read_csv(file);
  const std::size_t kind = column(table, file, "kind");
  const std::vector<double> id = table.numbers("id"), x = table.numbers("x"), y = table.numbers("y"),
                            z = table.numbers("z");
  std::map<std::int64_t, Eigen::Vector3d> out;
  for (std::size_t row = 0; row < table.rows.size(); ++row)
    if (table.rows[row][kind] == "anchor") out[static_cast<std::int64_t>(id[row])] = {x[row], y[row], z[row]};
  return out;
}

/// Poses with enough matches, in their order.
std::vector<std::size_t> determined(const std::vector<RecordedMatch>& matches, std::size_t poses) {
  std::vector<std::size_t> count(poses), out;
  for (const RecordedMatch& match : matches) ++count[match.pose];
  for (std::size_t k = 0; k < poses; ++k)
    if (count[k] >= least_matches) out.push_back(k);
  return out;
}

std::vector<std::size_t> evenly_spaced(const std::vector<std::size_t>& all, std::size_t most) {
  if (all.size() <= most) return all;
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < most; ++i) out.push_back(all[i * (all.size() - 1) / (most - 1)]);
  return out;
}

}  // namespace

RecordedMatches read_matches(const fs::path& run, std::size_t most_views) {
  if (!fs::exists(run / "measurements.csv"))
    throw InputError(run.string() + ": is no run directory: it has no measurements.csv");
  if (fs::exists(run / "estimate-2.tum"))
    throw InputError(run.string() + ": is the run of a team: only a run of one camera can be adjusted");
  RecordedMatches out;
  out.estimate = read_trajectory(run / "estimate.tum");
  const std::vector<RecordedMatch> matches = read_matched(run / "measurements.csv", out.estimate);
  out.view = evenly_spaced(determined(matches, out.estimate.size()), most_views);
  if (out.view.size() < 2)
    throw InputError(fmt::format("{}: {} frames with {} matches or more: two are needed", run.string(),
                                 out.view.size(), least_matches));
  for (const std::size_t k : out.view)
    out.matches.views.push_back({out.estimate[k].position, out.estimate[k].orientation});
  for (const RecordedMatch& match : matches) {
    const auto view = std::ranges::lower_bound(out.view, match.pose);
    if (view == out.view.end() || *view != match.pose) continue;
    out.matches.pixels[match.id].emplace_back(static_cast<int>(view - out.view.begin()), match.pixel);
  }
  out.matches.known = read_anchors(run / "map.csv");
  return out;
}

}  // namespace incognita
