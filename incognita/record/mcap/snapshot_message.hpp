// Serializes a snapshot for replay.
#pragma once

#include <string>

#include "incognita/record/snapshot/snapshot.hpp"

namespace incognita {

/// incognita.Snapshot as JSON: the snapshot without image, truth and timings (which differ between runs).
/// Unknown values are omitted. Contains the full map if `landmarks`, else the landmark ids only.
std::string snapshot_message(const Snapshot& snapshot, bool landmarks);

}  // namespace incognita
