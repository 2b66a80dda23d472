// Detects that the odometry and the scans of a recording use different clocks or time units.
#pragma once

#include <string>
#include <vector>

#include "incognita/world/replay/range_recording.hpp"

namespace incognita {

/// One sentence with numbers per symptom; empty for a recording without odometry or scans.
std::vector<std::string> clock_warnings(const RangeRecording& recording);

}  // namespace incognita
