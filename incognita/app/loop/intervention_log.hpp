// Reads the interventions of an earlier run.
#pragma once

#include <filesystem>
#include <vector>

#include "incognita/record/snapshot/interventions.hpp"

namespace incognita {

/// Of interventions.jsonl in a run directory; empty if nobody intervened. Throws InputError that names file and line.
std::vector<LoggedIntervention> read_intervention_log(const std::filesystem::path& run_directory);

}  // namespace incognita
