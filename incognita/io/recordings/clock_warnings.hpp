// Signs that the odometry and the scans of a recording are on different clocks, or in different units of
// time.
#pragma once

#include <string>
#include <vector>

#include "incognita/world/replay/range_recording.hpp"

namespace incognita {

/// A sentence for each sign, with its numbers; none for a recording without odometry or scans.
std::vector<std::string> clock_warnings(const RangeRecording& recording);

}  // namespace incognita
