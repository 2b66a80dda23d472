#include "incognita/live/series_history.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "incognita/record/snapshot/interventions.hpp"
#include "incognita/record/snapshot/series.hpp"

namespace incognita {
namespace {

using Json = nlohmann::json;

constexpr std::size_t most_events = 5000;
constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

/// Rows of `width` numbers, one after the other.
struct Rows {
  const std::vector<double>& numbers;
  std::size_t width;
  std::size_t size() const { return width ? numbers.size() / width : 0; }
  double at(std::size_t row, std::size_t column) const { return numbers[row * width + column]; }
};

Json column_of(const Rows& rows, std::size_t column) {
  Json values = Json::array();
  for (std::size_t i = 0; i < rows.size(); ++i) values.push_back(number(rows.at(i, column)));
  return values;
}

Json states_of(const Rows& rows) {
  Json states = Json::array();
  for (std::size_t i = 0; i < rows.size(); ++i)
    states.push_back(name(static_cast<TrackingState>(static_cast<int>(rows.at(i, 1)))));
  return states;
}

/// Of the position that begins at that column.
Json path_of(const Rows& rows, std::size_t column) {
  Json path = Json::array();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double x = rows.at(i, column), y = rows.at(i, column + 1), z = rows.at(i, column + 2);
    path.push_back(std::isfinite(x + y + z) ? Json{x, y, z} : Json(nullptr));
  }
  return path;
}

}  // namespace

SeriesHistory::SeriesHistory(bool with_errors, std::size_t bodies, std::size_t most_rows)
    : names_(series_columns(with_errors)),
      with_errors_(with_errors),
      bodies_(bodies),
      most_rows_(most_rows) {}

void SeriesHistory::add_events(const Snapshot& snapshot) {
  const auto event = [&](std::string kind, std::string text) {
    if (kept_.events.size() >= most_events) kept_.events.pop_front();
    kept_.events.push_back({kept_.frames, snapshot.tick.t, std::move(kind), std::move(text)});
  };
  const TrackingState state = snapshot.status.state;
  if (state != last_state_ && (state == TrackingState::lost || state == TrackingState::relocated))
    event(name(state), snapshot.status.reason);
  last_state_ = state;
  for (const SnapshotLandmark& landmark : snapshot.landmarks)
    if (!landmark.anchor && initialized_.insert(landmark.id).second)
      event("initialized", "landmark " + std::to_string(landmark.id));
  for (const SnapshotBody& body : snapshot.bodies)
    if (body.decision.decided) event("decision", chosen_action(body.decision));
  for (const Intervention& intervention : snapshot.interventions) event("disturbance", name(intervention));
}

void SeriesHistory::begin(const Snapshot& first) {
  for (const auto& [stage, ms] : first.timing_ms) kept_.stages.emplace_back(stage);
  width_ = 2 + names_.size() + kept_.stages.size() + 6 * bodies_;
  kept_.rows.reserve(most_rows_ * width_);
}

void SeriesHistory::add_row(const Snapshot& snapshot) {
  const std::vector<double> series = series_row(snapshot, with_errors_);
  auto to = kept_.rows.insert(kept_.rows.end(), width_, unknown);
  *to++ = snapshot.tick.t;
  *to++ = static_cast<double>(snapshot.status.state);
  to = std::copy(series.begin(), series.end(), to);
  for (std::size_t i = 0; i < std::min(kept_.stages.size(), snapshot.timing_ms.size()); ++i)
    to[static_cast<std::ptrdiff_t>(i)] = snapshot.timing_ms[i].second;
  to += static_cast<std::ptrdiff_t>(kept_.stages.size());
  for (std::size_t i = 0; i < std::min(bodies_, snapshot.bodies.size()); ++i, to += 6) {
    const SnapshotBody& body = snapshot.bodies[i];
    if (has_pose(body)) std::copy_n(body.estimate.position.data(), 3, to);
    if (body.truth) std::copy_n(body.truth->position.data(), 3, to + 3);
  }
}

/// Keeps every other row.
void SeriesHistory::thin() {
  const auto begin = kept_.rows.begin();
  std::size_t kept = 0;
  for (std::size_t at = 0; at < kept_.rows.size(); at += 2 * width_, kept += width_)
    std::copy_n(begin + static_cast<std::ptrdiff_t>(at), width_, begin + static_cast<std::ptrdiff_t>(kept));
  kept_.rows.resize(kept);
  stride_ *= 2;
}

void SeriesHistory::add(const Snapshot& snapshot) {
  const std::lock_guard lock(mutex_);
  add_events(snapshot);
  if (kept_.frames == 0) begin(snapshot);
  if (kept_.frames++ % stride_ != 0) return;
  add_row(snapshot);
  if (kept_.rows.size() >= most_rows_ * width_) thin();
}

std::string SeriesHistory::json() const {
  std::unique_lock lock(mutex_);
  const Kept kept = kept_;
  const Rows rows{kept.rows, width_};
  const std::int64_t stride = stride_;
  lock.unlock();
  Json json{{"t", column_of(rows, 0)},
            {"frames", kept.frames},
            {"first_frame", 0},
            {"frame_step", stride},
            {"state", states_of(rows)}};
  std::size_t at = 2;
  Json& columns = json["columns"] = Json::object();
  for (const std::string& name : names_) columns[name] = column_of(rows, at++);
  Json& timing = json["timing_ms"] = Json::object();
  for (const std::string& stage : kept.stages) timing[stage] = column_of(rows, at++);
  Json& paths = json["paths"] = Json::array();
  for (std::size_t i = 0; i < bodies_; ++i, at += 6)
    paths.push_back({{"estimate", path_of(rows, at)}, {"truth", path_of(rows, at + 3)}});
  Json& events = json["events"] = Json::array();
  for (const Event& event : kept.events)
    events.push_back({{"frame", event.frame}, {"t", event.t}, {"kind", event.kind}, {"text", event.text}});
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace incognita
