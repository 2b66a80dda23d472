// Recordings of a vehicle that measures ranges and bearings: from public data sets as they are published, and
// from plain tables.
#pragma once

#include <filesystem>
#include <string>

#include "incognita/io/scenario/load_scenario.hpp"
#include "incognita/world/replay/range_recording.hpp"

namespace incognita {

/// `format` is `auto`, `acfr`, `mrclam` or `tables`; `robot` (1 to 5) chooses among those of `mrclam`.
/// docs/range-recordings.md says how each is laid out. Throws InputError naming the file, the line or the
/// variable and its index, and what would be right.
RangeRecording read_range_recording(const std::filesystem::path& folder, const std::string& format,
                                    int robot = 1);

/// The recording that a scenario names, found under the data folder.
RangeRecording read_range_recording(const LoadedScenario& loaded);

/// The same recording as the format `tables`, with every digit; notes are not written. Makes the folder;
/// throws RecordError when one of the tables is already there, or cannot be written.
void write_range_tables(const RangeRecording& recording, const std::filesystem::path& folder);

}  // namespace incognita
