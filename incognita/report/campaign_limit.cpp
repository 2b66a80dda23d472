#include "incognita/report/campaign_limit.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "incognita/messages/errors.hpp"
#include "incognita/record/files/number.hpp"
#include "incognita/report/campaign_statistics.hpp"

namespace incognita {

std::optional<LimitMeasure> limit_measure(const std::string& name) {
  for (const bool below : {true, false}) {
    const std::string word = below ? ".below:" : ".above:";
    const std::size_t at = name.find(word);
    if (at == std::string::npos) continue;
    const std::string number = name.substr(at + word.size());
    const auto limit = parse_number(number);
    if (at == 0 || !limit || !std::isfinite(*limit))
      throw InputError(fmt::format(
          "--measure {}: a limit is a number after the name of a measure, as in ate_m{}0.1", name, word));
    if (name.substr(0, at) == "failed")
      throw InputError(
          fmt::format("--measure {}: `failed` is the share of runs that failed; it has no limit", name));
    return LimitMeasure{name, name.substr(0, at), below, *limit};
  }
  return std::nullopt;
}

std::vector<LimitMeasure> limit_measures(const std::vector<std::string>& names) {
  std::vector<LimitMeasure> found;
  for (const std::string& name : names)
    if (auto measure = limit_measure(name)) found.push_back(std::move(*measure));
  return found;
}

std::vector<std::string> base_names(const std::vector<std::string>& names) {
  std::vector<std::string> bases;
  for (const std::string& name : names) {
    const auto measure = limit_measure(name);
    bases.push_back(measure ? measure->base : name);
  }
  return bases;
}

double success(const LimitMeasure& measure, bool done, const Measures& measures, bool known_to_any) {
  if (!done) return 0;
  const double value = value_of(measures, measure.base);
  if (std::isnan(value)) return known_to_any ? 0 : std::numeric_limits<double>::quiet_NaN();
  return (measure.below ? value < measure.limit : value > measure.limit) ? 1 : 0;
}

}  // namespace incognita
