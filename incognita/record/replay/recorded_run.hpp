// A run directory for replay.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "incognita/record/mcap/mcap_reader.hpp"
#include "incognita/record/replay/snapshot_scan.hpp"

namespace incognita {

/// Frames are read on demand. Several threads may read at once.
class RecordedRun {
 public:
  /// `path`: of the run directory or of its run.mcap. Throws InputError, naming file and remedy, if it cannot be replayed. A
  /// run whose end is missing or damaged has the frames before: see damage().
  explicit RecordedRun(const std::filesystem::path& path);

  /// Name of the run directory.
  const std::string& name() const { return name_; }
  /// Why frames are missing at the end, with file and byte; empty if none is.
  const std::string& damage() const { return scan_.damage; }
  std::int64_t frames() const { return static_cast<std::int64_t>(scan_.frames.size()); }

  /// What is known of the run, for drawing: the message incognita.Run completed by `expected_frames`, `effective_toml`,
  /// `interventions` (all of the run) and `damage` (if there is any). Runs of earlier versions lack some of it.
  std::string info_json() const;
  /// The columns of series.csv and timings.csv, one value per frame, null where unknown, and the events. Throws InputError
  /// if a table is damaged or of another run; if it is missing or ends early, its values are unknown.
  std::string series_json() const;
  /// {"snapshot": ...} of a frame, from 0, with its most recent landmarks and exploration volume; at the last frame of a
  /// whole run the landmarks of map.csv. Throws InputError if there is no such frame.
  std::string frame_json(std::int64_t frame) const;
  /// The most recent image at a frame, JPEG; nothing before the first. Throws InputError if there is no such frame.
  std::optional<std::string> image(std::int64_t frame) const;
  /// summary.json. Throws InputError if it is missing or damaged.
  std::string summary_json() const;

 private:
  const bags::MessagePlace& snapshot_at(std::int64_t frame) const;

  std::filesystem::path directory_;
  std::string name_;
  McapReader log_;
  SnapshotScan scan_;
};

}  // namespace incognita
