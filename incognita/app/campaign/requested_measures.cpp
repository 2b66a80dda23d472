#include "incognita/app/campaign/requested_measures.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "incognita/math/nearest_name.hpp"
#include "incognita/report/campaign_limit.hpp"
#include "incognita/report/campaign_measures.hpp"

namespace incognita {
namespace {

bool is_among(const std::string& name, const std::vector<std::string>& names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

RequestedMeasures::RequestedMeasures(const std::vector<std::string>& names, const CampaignPlan& plan,
                                     const CampaignFolder& folder)
    : names_(base_names(names)) {
  if (names_.empty()) return;
  for (std::size_t v = 0; v < plan.variants.size(); ++v) silent_.insert(v);
  variants_ = plan.variants.size();
  for (std::size_t run = 0; run < plan.runs(); ++run)
    if (const auto result = folder.read(run)) add(run, *result);
}

void RequestedMeasures::add(std::size_t run, const RunResult& result) {
  if (names_.empty() || result.summary_json.empty()) return;
  for (const auto& [name, value] : measures_of(result.summary_json).measures)
    if (!is_among(name, known_)) known_.push_back(name);
  if (result.status == "done") silent_.erase(run % variants_);
}

std::string RequestedMeasures::problem() const {
  return silent_.empty() ? unknown_measure(names_, known_) : "";
}

std::string unknown_measure(const std::vector<std::string>& requested,
                            const std::vector<std::string>& known) {
  for (const std::string& name : requested)
    if (!is_among(name, known))
      return fmt::format("--measure {}: no run has this measure; the nearest is {}. Completed runs are kept",
                         name, nearest_name(name, known));
  return "";
}

}  // namespace incognita
