// Success as a measure: whether a run ended done and on the right side of a stated limit.
//
// A mean error over the runs that are done rewards a variant for losing its hard seeds. A success has a value
// for every run that ended, a run that failed being none, so that nothing is selected by its outcome.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "incognita/report/campaign_measures.hpp"

namespace incognita {

struct LimitMeasure {
  std::string name;  ///< "ate_m.below:0.1"
  std::string base;  ///< "ate_m"
  bool below = true;
  double limit = 0;
};

/// Nothing for a name without `.below:` or `.above:`. Throws InputError where no number follows, and for
/// `failed`, which is a share already.
std::optional<LimitMeasure> limit_measure(const std::string& name);

/// Those among the names, in their order.
std::vector<LimitMeasure> limit_measures(const std::vector<std::string>& names);

/// The names of summary.json's own behind the wanted ones.
std::vector<std::string> base_names(const std::vector<std::string>& names);

/// 1 for a success, else 0. A run that is done without a value, as of what never happened in it, is none;
/// where no run of the campaign has one (`known_to_any`), nothing was measured, and it is NaN.
double success(const LimitMeasure& measure, bool done, const Measures& measures, bool known_to_any);

}  // namespace incognita
