#include "incognita/app/commands/recorded_matches.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
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
  bool anchor;
  Eigen::Vector2d pixel;
};

std::size_t column(const CsvTable& table, const fs::path& file, std::string_view name) {
  const auto found = table.find(name);
  if (!found) throw InputError(fmt::format("{}:1: there is no column `{}`", file.string(), name));
  return *found;
}

/// A column of numbers; NaN where a cell is none.
std::vector<double> numbers(const CsvTable& table, const fs::path& file, std::string_view name) {
  column(table, file, name);
  return table.numbers(name);
}

/// Every integer of this size is a double.
bool is_number_of_landmark(double id) { return std::abs(id) < 9e15 && id == std::floor(id); }

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
  const std::vector<double> t = numbers(table, file, "t"), id = numbers(table, file, "id"),
                            u = numbers(table, file, "measured_1"), v = numbers(table, file, "measured_2");
  std::vector<RecordedMatch> out;
  std::size_t pose = 0;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const std::vector<std::string>& cells = table.rows[row];
    if (cells[outcome] != "matched" || (cells[kind] != "landmark" && cells[kind] != "anchor")) continue;
    if (!std::isfinite(t[row]) || !is_number_of_landmark(id[row]) || !std::isfinite(u[row]) ||
        !std::isfinite(v[row]))
      throw InputError(fmt::format(
          "{}:{}: t, measured_1 and measured_2 of a match must be finite numbers, and its id an integer",
          file.string(), row + 2));
    while (pose < estimate.size() && estimate[pose].t < t[row] - same_time_s) ++pose;
    if (pose == estimate.size()) break;
    if (estimate[pose].t > t[row] + same_time_s) continue;
    out.push_back({pose, static_cast<std::int64_t>(id[row]), cells[kind] == "anchor", {u[row], v[row]}});
  }
  return out;
}

/// The exact positions of the anchors that are matched.
std::map<std::int64_t, Eigen::Vector3d> read_anchors(const fs::path& file,
                                                     const std::vector<RecordedMatch>& matches) {
  std::map<std::int64_t, Eigen::Vector3d> out;
  if (std::ranges::none_of(matches, &RecordedMatch::anchor)) return out;
  if (!fs::exists(file))
    throw InputError(
        file.string() +
        ": does not exist, and has the positions of the anchors: the run did not come to its end");
  const CsvTable table = read_csv(file);
  const std::size_t kind = column(table, file, "kind");
  const std::vector<double> id = numbers(table, file, "id"), x = numbers(table, file, "x"),
                            y = numbers(table, file, "y"), z = numbers(table, file, "z");
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    if (table.rows[row][kind] != "anchor") continue;
    const Eigen::Vector3d at(x[row], y[row], z[row]);
    if (!is_number_of_landmark(id[row]) || !at.allFinite())
      throw InputError(
          fmt::format("{}:{}: x, y and z of an anchor must be finite numbers, and its id an integer",
                      file.string(), row + 2));
    out[static_cast<std::int64_t>(id[row])] = at;
  }
  for (const RecordedMatch& match : matches)
    if (match.anchor && !out.contains(match.id))
      throw InputError(
          fmt::format("{}: has no anchor {}, which measurements.csv has", file.string(), match.id));
  return out;
}

/// Of the views, those with enough matches of anchors and of landmarks that are matched often enough in them, in their order.
std::vector<std::size_t> determined(std::vector<std::size_t> views,
                                    const std::vector<RecordedMatch>& matches) {
  for (;;) {
    std::map<std::int64_t, std::size_t> of_landmark;
    std::map<std::size_t, std::size_t> of_view;
    const auto is_in_view = [&](const RecordedMatch& match) {
      return std::ranges::binary_search(views, match.pose);
    };
    for (const RecordedMatch& match : matches) of_landmark[match.id] += is_in_view(match);
    for (const RecordedMatch& match : matches)
      if (is_in_view(match) && (match.anchor || of_landmark[match.id] >= least_matches_of_landmark))
        ++of_view[match.pose];
    if (std::erase_if(views, [&](std::size_t view) { return of_view[view] < least_matches; }) == 0)
      return views;
  }
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
  std::vector<std::size_t> all(out.estimate.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  out.view = determined(evenly_spaced(determined(std::move(all), matches), most_views), matches);
  if (out.view.size() < 2)
    throw InputError(fmt::format(
        "{}: {} frames with {} matches or more, of landmarks that are matched in {} of them: two are needed",
        run.string(), out.view.size(), least_matches, least_matches_of_landmark));
  for (const std::size_t k : out.view)
    out.matches.views.push_back({out.estimate[k].position, out.estimate[k].orientation});
  for (const RecordedMatch& match : matches) {
    const auto view = std::ranges::lower_bound(out.view, match.pose);
    if (view == out.view.end() || *view != match.pose) continue;
    out.matches.pixels[match.id].emplace_back(static_cast<int>(view - out.view.begin()), match.pixel);
  }
  out.matches.known = read_anchors(run / "map.csv", matches);
  return out;
}

std::size_t least_shared(const RunMatches& matches) {
  std::vector<std::size_t> shared(matches.views.size() - 1);
  for (const auto& [id, pixels] : matches.pixels)
    for (std::size_t i = 1; i < pixels.size(); ++i)
      if (pixels[i].first == pixels[i - 1].first + 1) ++shared[static_cast<std::size_t>(pixels[i - 1].first)];
  return *std::ranges::min_element(shared);
}

}  // namespace incognita
