// The time series of a recorded run.
#pragma once

#include <filesystem>
#include <string>

#include "incognita/record/replay/snapshot_scan.hpp"

namespace incognita {

/// series.csv, timings.csv and the events as JSON: RecordedRun::series_json().
std::string recorded_series(const std::filesystem::path& directory, const SnapshotScan& scan);

}  // namespace incognita
