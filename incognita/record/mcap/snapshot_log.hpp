// run.mcap: the snapshots of a run, for replay and for viewers.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "incognita/record/mcap/mcap_file.hpp"
#include "incognita/record/mcap/snapshot_topics.hpp"

namespace incognita {

/// All topics, each created with its first message. The file does not depend on the wall clock or on computation time:
/// the same snapshots give the same bytes.
class SnapshotLog final : private TopicSink {
 public:
  /// Throws RecordError if the file cannot be created.
  SnapshotLog(const std::filesystem::path& path, const RunInfo& info);

  /// Throws RecordError if a write fails; the file stays valid and is closed.
  void publish(const Snapshot& snapshot);
  /// Writes the final map and closes the file.
  void close(const std::vector<SnapshotLandmark>& map);

 private:
  void put(const Topic& topic, std::uint64_t time_ns, std::string message) override;

  McapFile file_;
  SnapshotTopics topics_;
  std::map<std::string_view, std::uint16_t> channels_;  ///< by topic
};

}  // namespace incognita
