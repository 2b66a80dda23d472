// run.mcap: the snapshots of a run, for replay and for the viewers of the field.
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

/// Topics, each there once it has something to say:
///
/// - /snapshot: incognita.Snapshot, every frame, the full map in it about once a second.
/// - /tf: where the `camera` is in the `world` and where the `true_camera` is. The truth has a world of its
/// own,
///   `true_world`, when the two are not the same frame.
/// - /estimate/pose, /truth/pose: the same as poses. No estimate while starting or lost.
/// - /camera/image: the image, as JPEG. /camera/annotations: search ellipses and found patches over it. At
/// most
///   about 20 a second, of a faster camera every other: they are most of the file.
/// - /map: the landmarks, about once a second and at the end.
///
/// Times are the tick's, in nanoseconds; one before 0 counts as 0. Nothing in the file comes from the clock
/// on the wall or from how fast the machine was: same snapshots, same bytes.
class SnapshotLog {
 public:
  /// Throws RecordError when the file cannot be made.
  SnapshotLog(const std::filesystem::path& path, const RunInfo& info);

  /// Throws RecordError when the disk refuses; the file stays valid and takes no more.
  void publish(const Snapshot& snapshot);
  /// Writes the map as it is at the end, and closes the file.
  void close(const std::vector<SnapshotLandmark>& map);

 private:
  struct Topic {
    const char* name;
    const char* schema_name;
    std::string (*schema)();
  };
  static const Topic transforms, estimated_poses, true_poses, images, annotations, maps, snapshots;

  void put(const Topic& topic, const std::string& message);
  void put_poses(const Snapshot& snapshot);
  void put_others(const Snapshot& snapshot);
  void put_picture(const Snapshot& snapshot);

  McapFile file_;
  std::map<std::string_view, std::uint16_t> channels_;  ///< by topic
  std::string_view true_world_;
  std::string body_;  ///< name of the moving frame
  int patch_size_px_;
  std::uint64_t time_ns_ = 0;                                   ///< of the last snapshot
  std::optional<std::uint64_t> map_time_ns_, picture_time_ns_;  ///< of the last one in the file
};

}  // namespace incognita
