// Reads recordings of a vehicle with a range-bearing sensor: public data sets as published, and plain tables.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "incognita/io/scenario/load_scenario.hpp"
#include "incognita/world/replay/range_recording.hpp"

namespace incognita {

/// `format` is `auto`, `acfr`, `mrclam` or `tables`, see docs/range-recordings.md; `robot` (1 to 5) selects a
/// robot of `mrclam`. Throws InputError naming the file, the line or the variable and its index, and the remedy.
RangeRecording read_range_recording(const std::filesystem::path& folder, const std::string& format,
                                    int robot = 1);

/// The recording named by a scenario, searched under the data folder. Throws InputError also for the number of a robot
/// in a recording of one vehicle.
RangeRecording read_range_recording(const LoadedScenario& loaded);
/// The robots of the team recording named by a scenario. Throws InputError also for a recording of one vehicle.
std::vector<RangeRecording> read_team_recording(const LoadedScenario& loaded);

/// Writes a recording in the format `tables`, with full precision; notes are not written. Creates the folder;
/// throws RecordError if one of the tables already exists or cannot be written.
void write_range_tables(const RangeRecording& recording, const std::filesystem::path& folder);

}  // namespace incognita
