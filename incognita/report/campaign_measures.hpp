// What a run measured, by name, from its summary.json.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace incognita {

/// Names and values; NaN where a run has a measure and no value for it.
using Measures = std::vector<std::pair<std::string, double>>;

struct RunMeasures {
  Measures measures;  ///< the same whenever the run is repeated
  Measures timings;   ///< `timing_ms.*`, which are not
};

/// Every number, in the order of the document: `ate_m`, `entropy.total`, `vehicles.1.mean_nees`,
/// `observability.directions.scale.estimated_sigma`. An item of a list goes by its `name` if it has one, else
/// by its place, from 1. The seed is none of them. Throws std::invalid_argument when the text is no JSON
/// object.
RunMeasures measures_of(const std::string& summary_json);

}  // namespace incognita
