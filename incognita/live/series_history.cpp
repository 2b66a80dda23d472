#include "incognita/live/series_history.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "incognita/record/snapshot/interventions.hpp"
#include "incognita/record/snapshot/series.hpp"

namespace incognita {
namespace {

using Json = nlohmann::json;

constexpr std::size_t most_events = 5000;

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json column_of(const std::vector<std::vector<double>>& rows, std::size_t column) {
  Json values = Json::array();
  for (const auto& row : rows) values.push_back(number(row[column]));
  return values;
}

Json position(const std::optional<Eigen::Vector3d>& known) {
  return known && known->allFinite() ? Json{known->x(), known->y(), known->z()} : Json(nullptr);
}

template <class Value>
void keep_every_other(std::vector<Value>& values) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < values.size(); i += 2) std::swap(values[kept++], values[i]);
  values.resize(kept);
}

}  // namespace

SeriesHistory::SeriesHistory(bool with_errors, std::size_t most_rows)
    : names_(series_columns(with_errors)), with_errors_(with_errors), most_rows_(most_rows) {}

void SeriesHistory::add_events(const Snapshot& snapshot) {
  const auto event = [&](std::string kind, std::string text) {
    if (events_.size() >= most_events) events_.erase(events_.begin());
    events_.push_back({frames_, snapshot.tick.t, std::move(kind), std::move(text)});
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

void SeriesHistory::thin() {
  keep_every_other(t_), keep_every_other(state_), keep_every_other(rows_), keep_every_other(timing_ms_),
      keep_every_other(positions_);
  stride_ *= 2;
}

void SeriesHistory::add(const Snapshot& snapshot) {
  const std::lock_guard lock(mutex_);
  add_events(snapshot);
  if (frames_++ % stride_ != 0) return;
  if (stages_.empty())
    for (const auto& [stage, ms] : snapshot.timing_ms) stages_.emplace_back(stage);
  t_.push_back(snapshot.tick.t);
  state_.push_back(snapshot.status.state);
  rows_.push_back(series_row(snapshot, with_errors_));
  timing_ms_.emplace_back(stages_.size());
  for (std::size_t i = 0; i < stages_.size() && i < snapshot.timing_ms.size(); ++i)
    timing_ms_.back()[i] = snapshot.timing_ms[i].second;
  auto& positions = positions_.emplace_back();
  for (const SnapshotBody& body : snapshot.bodies) {
    positions.emplace_back();
    if (has_pose(body)) positions.back().estimate = body.estimate.position;
    if (body.truth) positions.back().truth = body.truth->position;
  }
  if (rows_.size() >= most_rows_) thin();
}

std::string SeriesHistory::json() const {
  const std::lock_guard lock(mutex_);
  Json json{{"t", t_}, {"frames", frames_}, {"first_frame", 0}};
  Json& states = json["state"] = Json::array();
  for (const TrackingState state : state_) states.push_back(name(state));
  Json& columns = json["columns"] = Json::object();
  for (std::size_t i = 0; i < names_.size(); ++i) columns[names_[i]] = column_of(rows_, i);
  Json& timing = json["timing_ms"] = Json::object();
  for (std::size_t i = 0; i < stages_.size(); ++i) timing[stages_[i]] = column_of(timing_ms_, i);
  std::size_t bodies = 0;
  for (const auto& positions : positions_) bodies = std::max(bodies, positions.size());
  Json& paths = json["paths"] = Json::array();
  for (std::size_t i = 0; i < bodies; ++i) {
    Json estimate = Json::array(), truth = Json::array();
    for (const auto& positions : positions_) {
      const Position at = i < positions.size() ? positions[i] : Position{};
      estimate.push_back(position(at.estimate)), truth.push_back(position(at.truth));
    }
    paths.push_back({{"estimate", std::move(estimate)}, {"truth", std::move(truth)}});
  }
  Json& events = json["events"] = Json::array();
  for (const Event& event : events_)
    events.push_back({{"frame", event.frame}, {"t", event.t}, {"kind", event.kind}, {"text", event.text}});
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace incognita
