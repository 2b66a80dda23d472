// run.mcap: the snapshots of a run, for replay and for viewers.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "incognita/record/mcap/mcap_file.hpp"
#include "incognita/record/snapshot/snapshot.hpp"
#include "incognita/record/summary/run_summary.hpp"

namespace incognita {

/// Topics, each created with its first message:
///
/// - /run: incognita.Run, once, before everything else, at the time of the first snapshot.
/// - /snapshot: incognita.Snapshot, every frame, with the full map and the exploration volume about once per second.
/// - /tf: pose of `camera` (or `vehicle`) in `world`, and of `true_camera` (`true_vehicle`). The truth has
///   its own root frame, `true_world`, if it is not expressed in the frame of the estimate.
/// - /estimate/pose, /truth/pose: the same as poses. No estimate while starting or lost.
/// - /camera/image: the image as JPEG. /camera/annotations: search ellipses and matched patches. Limited to
///   about 20 per second (every other image of a 30 Hz camera), because images dominate the file size.
/// - /map: the landmarks, about once per second and at the end.
///
/// Times are those of the ticks in ns; negative times count as 0. The file does not depend on the wall clock
/// or on computation time: the same snapshots give the same bytes.
class SnapshotLog {
 public:
  /// Throws RecordError if the file cannot be created.
  SnapshotLog(const std::filesystem::path& path, const RunInfo& info);

  /// Throws RecordError if a write fails; the file stays valid and is closed.
  void publish(const Snapshot& snapshot);
  /// Writes the final map and closes the file.
  void close(const std::vector<SnapshotLandmark>& map);

 private:
  struct Topic {
    const char* name;
    const char* schema_name;
    std::string (*schema)();
  };
  static const Topic transforms, estimated_poses, true_poses, images, annotations, maps, snapshots, run;

  void put(const Topic& topic, const std::string& message);
  void put_poses(const Snapshot& snapshot);
  void put_picture(const Snapshot& snapshot);

  McapFile file_;
  std::map<std::string_view, std::uint16_t> channels_;  ///< by topic
  std::string_view true_world_;
  std::string body_;  ///< name of the moving frame
  int patch_size_px_;
  std::string run_;            ///< the message about the run, until it is written
  std::uint64_t time_ns_ = 0;  ///< of the last snapshot
  std::optional<std::uint64_t> map_time_ns_, picture_time_ns_;  ///< of the last message in the file
};

}  // namespace incognita
