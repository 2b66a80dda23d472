// Serializes what is known of a run before it starts.
#pragma once

#include <string>

#include "incognita/record/summary/run_info.hpp"

namespace incognita {

/// incognita.Run as JSON. Unknown values are omitted.
std::string run_message(const RunInfo& info);

}  // namespace incognita
