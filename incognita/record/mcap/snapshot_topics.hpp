// The messages about a run, by topic: for run.mcap, and for viewers that speak Foxglove's protocol.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "incognita/record/snapshot/snapshot.hpp"
#include "incognita/record/summary/run_info.hpp"

namespace incognita {

struct Topic {
  const char* name;
  const char* schema_name;
  std::string (*schema)();  ///< JSON Schema
};

/// - /run: incognita.Run, once, before everything else, at the time of the first snapshot.
/// - /snapshot: incognita.Snapshot, every frame, with the full map and the exploration volume about once per second.
/// - /tf: pose of `camera` (or `vehicle`) in `world`, and of `true_camera` (`true_vehicle`). The truth has
///   its own root frame, `true_world`, if it is not expressed in the frame of the estimate.
/// - /estimate/pose, /truth/pose: the same as poses. No estimate while starting or lost.
/// - /camera/image: the image as JPEG. /camera/annotations: search ellipses and matched patches. Limited to
///   about 20 per second (every other image of a 30 Hz camera), because images dominate the size.
/// - /map: the landmarks, about once per second and at the end.
std::span<const Topic> all_topics();

/// Receives the messages.
class TopicSink {
 public:
  virtual ~TopicSink() = default;
  /// Whether a message on that topic, an element of all_topics(), would be used.
  virtual bool wants(const Topic&) const { return true; }
  virtual void put(const Topic& topic, std::uint64_t time_ns, std::string message) = 0;
};

/// Times are those of the ticks in ns; negative times count as 0. The same snapshots give the same messages.
class SnapshotTopics {
 public:
  explicit SnapshotTopics(const RunInfo& info);

  void publish(const Snapshot& snapshot, TopicSink& sink);
  /// The last map, unless its snapshot had it already.
  void finish(const std::vector<SnapshotLandmark>& map, TopicSink& sink);
  /// The next snapshot comes with all that is due once or rarely: for a viewer that joins.
  void repeat();

 private:
  void put_poses(const Snapshot& snapshot, TopicSink& sink) const;
  void put_picture(const Snapshot& snapshot, TopicSink& sink);

  std::string run_;  ///< the message about the run
  bool run_is_due_ = true;
  const char* true_world_;
  std::string body_;  ///< name of the moving frame
  int patch_size_px_;
  std::uint64_t time_ns_ = 0;                                   ///< of the last snapshot
  std::optional<std::uint64_t> map_time_ns_, picture_time_ns_;  ///< of the last message
};

}  // namespace incognita
