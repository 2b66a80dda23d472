// Formats the result of an observability analysis as text and as JSON.
#pragma once

#include <string>

#include "incognita/analysis/observability/observability.hpp"

namespace incognita {

/// A table, followed by the unobservable directions and the disagreements between the methods.
std::string observability_table(const SystemText& text, const ObservabilityAnalysis& analysis,
                                const ObservabilitySettings& settings);

/// A document of docs/schemas/observe.schema.json.
std::string observability_json(const ObservabilityAnalysis& analysis, const ObservabilitySettings& settings);

}  // namespace incognita
