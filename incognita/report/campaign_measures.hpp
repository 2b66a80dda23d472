// Extracts the named measures of a run from its summary.json.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace incognita {

/// Names and values; NaN if a run has the measure without a value.
using Measures = std::vector<std::pair<std::string, double>>;

struct RunMeasures {
  Measures measures;  ///< identical when the run is repeated
  Measures timings;   ///< `timing_ms.*`, which are not
};

/// Every number in document order: `ate_m`, `entropy.total`, `vehicles.1.mean_nees`,
/// `observability.directions.scale.estimated_sigma`. A list item is named by its `name` if it has one, else
/// by its index from 1. The seed is excluded. Throws std::invalid_argument if the text is not a JSON object.
RunMeasures measures_of(const std::string& summary_json);

}  // namespace incognita
