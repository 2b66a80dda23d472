#include "incognita/report/campaign_statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

namespace incognita {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

std::vector<std::string> names_of(const Campaign& campaign, Measures RunMeasures::*which) {
  std::vector<std::string> names;
  std::set<std::string> seen;
  for (const CampaignVariant& variant : campaign.variants)
    for (const CampaignRun& run : variant.runs)
      for (const auto& [name, value] : run.measured.*which)
        if (seen.insert(name).second) names.push_back(name);
  return names;
}

/// By seed; NaN where there is no value, or none to trust: a run that failed measured something else.
using BySeed = std::map<std::int64_t, double>;

BySeed values_of(const CampaignVariant& variant, const std::string& measure) {
  BySeed values;
  for (const CampaignRun& run : variant.runs)
    values[run.seed] = run.done ? value_of(run.measured.measures, measure) : unknown;
  return values;
}

BySeed failures_of(const CampaignVariant& variant) {
  BySeed failed;
  for (const CampaignRun& run : variant.runs) failed[run.seed] = run.done ? 0 : 1;
  return failed;
}

PairedComparison compare(const BySeed& values, const BySeed& reference) {
  std::vector<double> a, b;
  for (const auto& [seed, value] : values) {
    const auto same_seed = reference.find(seed);
    if (same_seed == reference.end()) continue;
    a.push_back(value);
    b.push_back(same_seed->second);
  }
  return compare_pairs(a, b);
}

std::vector<double> known(const BySeed& values) {
  std::vector<double> list;
  for (const auto& [seed, value] : values)
    if (!std::isnan(value)) list.push_back(value);
  return list;
}

MeasureStatistics statistics_of(const std::string& measure, const BySeed& values, const BySeed& reference) {
  const std::vector<double> list = known(values);
  const Interval none{unknown, unknown, unknown};
  return {measure, list.size(), list.empty() ? none : mean_of(list), median_of(list),
          compare(values, reference)};
}

}  // namespace

double value_of(const Measures& measures, const std::string& name) {
  const auto found =
      std::find_if(measures.begin(), measures.end(), [&](const auto& m) { return m.first == name; });
  return found == measures.end() ? unknown : found->second;
}

std::vector<std::string> measure_names(const Campaign& campaign) {
  return names_of(campaign, &RunMeasures::measures);
}

std::vector<std::string> timing_names(const Campaign& campaign) {
  return names_of(campaign, &RunMeasures::timings);
}

std::vector<VariantStatistics> statistics_of(const Campaign& campaign) {
  const CampaignVariant& baseline = campaign.variants[campaign.baseline];
  std::vector<VariantStatistics> all;
  for (const CampaignVariant& variant : campaign.variants) {
    VariantStatistics s;
    s.runs = campaign.seeds.size();
    for (const CampaignRun& run : variant.runs) ++(run.done ? s.done : s.failed);
    s.missing = s.runs - s.done - s.failed;
    s.measures.push_back(statistics_of("failed", failures_of(variant), failures_of(baseline)));
    s.measures.back().mean = share_of(s.failed, s.done + s.failed);
    all.push_back(std::move(s));
  }
  for (const std::string& measure : measure_names(campaign)) {
    const BySeed reference = values_of(baseline, measure);
    for (std::size_t v = 0; v < all.size(); ++v)
      all[v].measures.push_back(statistics_of(measure, values_of(campaign.variants[v], measure), reference));
  }
  return all;
}

}  // namespace incognita
