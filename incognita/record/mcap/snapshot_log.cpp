#include "incognita/record/mcap/snapshot_log.hpp"

namespace incognita {

SnapshotLog::SnapshotLog(const std::filesystem::path& path, const RunInfo& info)
    : file_(path, "incognita " + info.version), topics_(info) {}

void SnapshotLog::put(const Topic& topic, std::uint64_t time_ns, std::string message) {
  auto channel = channels_.find(topic.name);
  if (channel == channels_.end())
    channel =
        channels_.emplace(topic.name, file_.add_channel(topic.name, topic.schema_name, topic.schema())).first;
  file_.write(channel->second, time_ns, message);
}

void SnapshotLog::publish(const Snapshot& snapshot) {
  if (file_.is_open()) topics_.publish(snapshot, *this);
}

void SnapshotLog::close(const std::vector<SnapshotLandmark>& map) {
  if (file_.is_open()) topics_.finish(map, *this);
  file_.close();
}

}  // namespace incognita
