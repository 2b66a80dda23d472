// A whole run as the sections of a state file, and back.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "incognita/app/loop/loop.hpp"
#include "incognita/io/scenario/load_scenario.hpp"
#include "incognita/record/files/state_file.hpp"

namespace incognita {

class AssociationScore;
class Interventions;
class ObservabilityWatch;

/// Whatever has a state between two ticks. Those that are null do not take part.
struct RunState {
  LoopParts& parts;
  LoopState& loop;
  Interventions& interventions;
  ObservabilityWatch* watch = nullptr;
  AssociationScore* score = nullptr;
  bool ever_tracked = false, ever_measured = false;
};

/// The state of the clock alone: it is that of the end of a tick only until the clock is asked for the next one.
std::string saved_clock(Clock& clock);

/// `clock`: as saved_clock() at the end of the last tick. `program_version`: of this program. Throws InputError that names the part
/// which cannot be saved.
std::string saved_run(const LoadedScenario& loaded, RunState& run, const std::string& clock,
                      const std::string& program_version);

/// Restores the state of parts that were built from the scenario of that file. Throws InputError naming file and section; the
/// parts are then of no use.
void restore_run(const StateFile& file, RunState& run);

/// Restores the map alone, for a run of the same place in another scenario: its bodies are lost until their cameras recognize it.
/// Throws InputError if they could not, or if a setting on which the map depends is another one.
void restore_map(const StateFile& file, const LoadedScenario& loaded, RunState& run);

/// The scenario of a saved run. Only some settings can change in mid-course: throws InputError that names the others.
/// `interventions`: settings that were changed while it ran, and may be any.
LoadedScenario scenario_of(const StateFile& file, std::span<const std::string> sets = {},
                           std::span<const Flag> flags = {}, std::span<const std::string> interventions = {});

}  // namespace incognita
