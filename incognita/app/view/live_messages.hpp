// What the page is told about a live run besides its snapshots.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "incognita/analysis/observability/observability_report.hpp"
#include "incognita/io/scenario/load_scenario.hpp"
#include "incognita/messages/intervention.hpp"
#include "incognita/record/summary/run_info.hpp"

namespace incognita {

/// What is known of a run before its first frame, as JSON: docs/live-page.md. `frames`: expected; 0: unknown.
std::string live_info_json(const LoadedScenario& loaded, const RunInfo& info, std::int64_t frames);

/// The same after interventions that changed the strategy, the gaze, or a disturbance that stays in force; nothing if there
/// is none among them.
std::optional<std::string> changed_info_json(const std::string& info_json,
                                             const std::vector<Intervention>& interventions);

/// What the observability monitor says, as JSON fields without braces: "lines" and "directions".
std::string observability_fields(const ObservabilityReport& report);

/// The built-in scenarios and, if it is none of them, `further`, with their descriptions, as JSON.
std::string scenarios_json(const std::string& further);

}  // namespace incognita
