// What an observability analysis says, for people and for programs.
#pragma once

#include <string>

#include "incognita/analysis/observability/observability.hpp"

namespace incognita {

/// A table as a lecturer would show it, and under it what cannot be seen, and where the methods disagree.
std::string observability_table(const SystemText& text, const ObservabilityAnalysis& analysis,
                                const ObservabilitySettings& settings);

/// One JSON document; docs/schemas/observe.schema.json.
std::string observability_json(const ObservabilityAnalysis& analysis, const ObservabilitySettings& settings);

}  // namespace incognita
