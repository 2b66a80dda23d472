// A snapshot as the replay wants it back.
#pragma once

#include <string>

#include "incognita/record/snapshot/snapshot.hpp"

namespace incognita {

/// incognita.Snapshot, as JSON: all of the snapshot but its image, its truth and its timings (they differ
/// from run to run). What is not known is left out. With `landmarks`, the map in full; else the landmarks'
/// ids only.
std::string snapshot_message(const Snapshot& snapshot, bool landmarks);

}  // namespace incognita
