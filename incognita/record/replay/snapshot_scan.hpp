// One pass over the snapshots of a recorded run: times, states, events, and where the landmarks are.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "incognita/record/mcap/mcap_reader.hpp"

namespace incognita {

/// Of one body at one frame; none where it is unknown.
struct RecordedPosition {
  std::optional<std::array<double, 3>> estimate, truth;  ///< m, world
};

struct RecordedFrame {
  double t = 0;                                          ///< s
  std::string state;                                     ///< as in series.csv
  std::optional<std::size_t> landmarks_at, explored_at;  ///< most recent frame that has them
  std::vector<RecordedPosition> bodies = {};
};

struct RecordedEvent {
  std::size_t frame = 0;
  double t = 0;
  std::string kind;  ///< initialized, removed, lost, relocated, decision, disturbance
  std::string text;
};

struct SnapshotScan {
  std::vector<RecordedFrame> frames;
  std::vector<RecordedEvent> events;       ///< in the order of frames
  std::vector<std::string> interventions;  ///< JSON objects, in the order of frames
  int bodies = 0;
  std::string damage;  ///< file, byte and what is wrong after these frames; empty if nothing is
};

/// Reads all snapshots up to the first that is damaged. Throws InputError if that is the first one.
SnapshotScan scan_snapshots(const McapReader& log);

/// Topic of the snapshots.
inline constexpr const char* snapshot_topic = "/snapshot";

}  // namespace incognita
