#include "incognita/record/replay/snapshot_scan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>
#include <utility>

#include "incognita/messages/errors.hpp"
#include "incognita/record/files/json_limits.hpp"

namespace incognita {
namespace {

using UnorderedJson = nlohmann::json;

/// Collects the events of successive snapshots.
class EventFinder {
 public:
  void add(std::size_t frame, double t, const UnorderedJson& snapshot) {
    times_.push_back(t);
    add_landmarks(frame, snapshot);
    add_state(frame, snapshot);
    add_decisions(frame, snapshot.at("bodies"));
    if (const auto found = snapshot.find("interventions"); found != snapshot.end())
      for (const UnorderedJson& intervention : *found)
        put(frame, "disturbance", intervention.at("type").get<std::string>());
  }

  /// Of the first `frames` frames: a damaged one may have been added in part.
  std::vector<RecordedEvent> events(std::size_t frames) {
    for (const auto& [id, seen] : landmarks_) {
      if (anchors_.contains(id) || seen.first >= frames) continue;
      put(seen.first, "initialized", fmt::format("landmark {}", id));
      if (seen.second + 1 < frames) put(seen.second + 1, "removed", fmt::format("landmark {}", id));
    }
    std::erase_if(events_, [&](const RecordedEvent& event) { return event.frame >= frames; });
    std::stable_sort(events_.begin(), events_.end(),
                     [](const RecordedEvent& a, const RecordedEvent& b) { return a.frame < b.frame; });
    return std::move(events_);
  }

 private:
  void put(std::size_t frame, const char* kind, std::string text) {
    events_.push_back({frame, times_[frame], kind, std::move(text)});
  }

  /// A landmark that may be at infinity is missing for some frames, without being removed.
  void add_landmarks(std::size_t frame, const UnorderedJson& snapshot) {
    for (const UnorderedJson& id : snapshot.at("landmark_ids"))
      landmarks_.try_emplace(id.get<std::int64_t>(), frame, frame).first->second.second = frame;
    for (const char* list : {"landmarks", "matches"})
      if (const auto found = snapshot.find(list); found != snapshot.end())
        for (const UnorderedJson& landmark : *found)
          if (landmark.at("kind") == "anchor") anchors_.insert(landmark.at("id").get<std::int64_t>());
  }

  void add_state(std::size_t frame, const UnorderedJson& snapshot) {
    const auto state = snapshot.at("state").get<std::string>();
    if (state != state_ && (state == "lost" || state == "relocated"))
      put(frame, state == "lost" ? "lost" : "relocated", snapshot.value("reason", ""));
    state_ = state;
  }

  void add_decisions(std::size_t frame, const UnorderedJson& bodies) {
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      const auto found = bodies[i].find("decision");
      if (found == bodies[i].end() || !found->value("decided", false)) continue;
      const auto chosen = found->value("chosen", std::int64_t{-1});
      const UnorderedJson& candidates = found->at("candidates");
      if (chosen < 0 || static_cast<std::size_t>(chosen) >= candidates.size()) continue;
      const auto action = candidates[static_cast<std::size_t>(chosen)].at("action").get<std::string>();
      put(frame, "decision", bodies.size() > 1 ? fmt::format("body {}: {}", i + 1, action) : action);
    }
  }

  std::vector<RecordedEvent> events_;
  std::vector<double> times_;                                              ///< per frame
  std::map<std::int64_t, std::pair<std::size_t, std::size_t>> landmarks_;  ///< first and last frame, per id
  std::set<std::int64_t> anchors_;
  std::string state_;
};

std::optional<std::array<double, 3>> position_in(const UnorderedJson& json) {
  const auto found = json.find("position");
  if (found == json.end()) return std::nullopt;
  return std::array{found->at("x").get<double>(), found->at("y").get<double>(), found->at("z").get<double>()};
}

std::vector<RecordedPosition> positions_in(const UnorderedJson& bodies) {
  std::vector<RecordedPosition> positions;
  for (const UnorderedJson& body : bodies) {
    positions.push_back({position_in(body), {}});
    if (const auto truth = body.find("truth"); truth != body.end())
      positions.back().truth = position_in(*truth);
  }
  return positions;
}

class Scanner {
 public:
  void add(const std::string& text) {
    if (json_depth(text) > most_json_depth) throw std::length_error("nested too deep");
    const UnorderedJson snapshot = UnorderedJson::parse(text);
    RecordedFrame frame{snapshot.at("t").get<double>(), snapshot.at("state").get<std::string>(),
                        landmarks_at_, explored_at_};
    const std::size_t which = scan_.frames.size();
    if (snapshot.contains("landmarks")) frame.landmarks_at = which;
    if (snapshot.contains("exploration")) frame.explored_at = which;
    frame.bodies = positions_in(snapshot.at("bodies"));
    events_.add(which, frame.t, snapshot);
    if (const auto found = snapshot.find("interventions"); found != snapshot.end())
      for (const UnorderedJson& intervention : *found) scan_.interventions.push_back(intervention.dump());
    scan_.bodies = std::max(scan_.bodies, static_cast<int>(snapshot.at("bodies").size()));
    landmarks_at_ = frame.landmarks_at, explored_at_ = frame.explored_at;
    scan_.frames.push_back(std::move(frame));
  }

  SnapshotScan finish(std::string damage) {
    scan_.events = events_.events(scan_.frames.size());
    scan_.damage = std::move(damage);
    return std::move(scan_);
  }

  bool empty() const { return scan_.frames.empty(); }

 private:
  SnapshotScan scan_;
  EventFinder events_;
  std::optional<std::size_t> landmarks_at_, explored_at_;
};

}  // namespace

SnapshotScan scan_snapshots(const McapReader& log) {
  const auto& messages = log.messages(snapshot_topic);
  Scanner scanner;
  std::string damage = log.damage();
  for (const bags::MessagePlace& message : messages) {
    const auto damaged = [&](const std::string& why) {
      damage = fmt::format("{}: at byte {}: not a snapshot of this program: {}", log.path().string(),
                           message.offset, why);
    };
    try {
      scanner.add(log.text(message));
      continue;
    } catch (const InputError& error) {
      damage = error.what();
    } catch (const UnorderedJson::exception& error) {
      damaged(brief(error));
    } catch (const std::length_error& error) {
      damaged(brief(error));
    }
    if (scanner.empty()) throw InputError(damage + "; the run can not be replayed");
    break;
  }
  if (scanner.empty())
    throw InputError(log.path().string() +
                     ": no frame is complete; the run ended before its first chunk was written (2 s)" +
                     (damage.empty() ? "" : "; " + damage));
  return scanner.finish(std::move(damage));
}

}  // namespace incognita
