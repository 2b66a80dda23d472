// Serializes a snapshot for replay.
#pragma once

#include <string>

#include "incognita/record/snapshot/snapshot.hpp"

namespace incognita {

/// The particles of a ray are [[u, v, weight], ...] if grouped. Schemas for viewers have no lists of lists, hence a
/// message for them has [u, v, weight, u, ...].
enum class ParticleLists { grouped, flat };

/// incognita.Snapshot as JSON: the snapshot without image and timings (which differ between runs). Unknown values are
/// omitted. Contains the full map and the exploration volume if `landmarks`, else the landmark ids only.
std::string snapshot_message(const Snapshot& snapshot, bool landmarks,
                             ParticleLists particles = ParticleLists::grouped);

}  // namespace incognita
