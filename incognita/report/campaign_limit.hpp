// Success as a measure: whether a run was completed on the required side of a stated limit.
//
// A mean error over completed runs favors a variant that fails on hard seeds. Success is defined for every
// run that ended (a failed run counts as 0), so it has no selection bias.
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

/// Parses a name with `.below:` or `.above:`; nullopt for other names. Throws InputError if no number
/// follows, and for `failed`, which is already a share.
std::optional<LimitMeasure> limit_measure(const std::string& name);

/// The limit measures among the names, in their order.
std::vector<LimitMeasure> limit_measures(const std::vector<std::string>& names);

/// The names with limit measures replaced by the measures of summary.json they refer to.
std::vector<std::string> base_names(const std::vector<std::string>& names);

/// 1 for a success, else 0. A completed run without a value (e.g. of an event that did not happen) is no
/// success; NaN if no run of the campaign has a value (`known_to_any`), as nothing was measured.
double success(const LimitMeasure& measure, bool done, const Measures& measures, bool known_to_any);

}  // namespace incognita
