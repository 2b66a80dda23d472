// What is known of a recorded run besides its frames.
#pragma once

#include <filesystem>
#include <string>

#include "incognita/record/replay/snapshot_scan.hpp"

namespace incognita {

/// RecordedRun::info_json().
std::string recorded_info(const std::filesystem::path& directory, const std::string& name,
                          const McapReader& log, const SnapshotScan& scan);

/// RecordedRun::summary_json().
std::string recorded_summary(const std::filesystem::path& directory);

}  // namespace incognita
