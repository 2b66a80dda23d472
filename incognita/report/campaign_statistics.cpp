#include "incognita/report/campaign_statistics.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "incognita/math/unknown.hpp"

namespace incognita {
namespace {

std::vector<std::string> names_of(const Campaign& campaign, Measures RunMeasures::*which) {
  std::vector<std::string> names;
  std::set<std::string> seen;
  for (const CampaignVariant& variant : campaign.variants)
    for (const CampaignRun& run : variant.runs)
      for (const auto& [name, value] : run.measured.*which)
        if (seen.insert(name).second) names.push_back(name);
  return names;
}

/// Values by seed; NaN if missing, or if the run failed and its value is therefore not comparable.
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

bool is_known_to_any(const Campaign& campaign, const std::string& measure) {
  for (const CampaignVariant& variant : campaign.variants)
    for (const CampaignRun& run : variant.runs)
      if (run.done && std::isfinite(value_of(run.measured.measures, measure))) return true;
  return false;
}

BySeed successes_of(const CampaignVariant& variant, const LimitMeasure& measure, bool known_to_any) {
  BySeed successes;
  for (const CampaignRun& run : variant.runs)
    successes[run.seed] = success(measure, run.done, run.measured.measures, known_to_any);
  return successes;
}

void compare(const BySeed& values, const BySeed& reference, MeasureStatistics& s) {
  std::vector<double> a, b;
  for (const auto& [seed, value] : values) {
    const auto same_seed = reference.find(seed);
    if (same_seed == reference.end()) continue;
    a.push_back(value);
    b.push_back(same_seed->second);
  }
  s.versus_baseline = compare_pairs(a, b);
  s.pairs_left_out = a.size() - s.versus_baseline.pairs;
}

std::vector<double> known(const BySeed& values) {
  std::vector<double> list;
  for (const auto& [seed, value] : values)
    if (!std::isnan(value)) list.push_back(value);
  return list;
}

MeasureStatistics statistics_of(const std::string& measure, const BySeed& values, const BySeed& reference,
                                const VariantStatistics& variant) {
  const std::vector<double> list = known(values);
  const Interval none{unknown, unknown, unknown};
  MeasureStatistics s;
  s.measure = measure;
  s.n = list.size();
  s.ended = variant.done + variant.failed;
  s.share_failed = share_of(variant.failed, s.ended).value;
  s.mean = list.empty() ? none : mean_of(list);
  s.median = median_of(list);
  compare(values, reference, s);
  return s;
}

/// Statistics of a measure whose values are 0 or 1.
MeasureStatistics share_statistics_of(const std::string& measure, const BySeed& values,
                                      const BySeed& reference, const VariantStatistics& variant) {
  MeasureStatistics s = statistics_of(measure, values, reference, variant);
  const std::vector<double> list = known(values);
  s.mean = share_of(static_cast<std::size_t>(std::count(list.begin(), list.end(), 1.0)), list.size());
  return s;
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

std::vector<VariantStatistics> statistics_of(const Campaign& campaign,
                                             const std::vector<LimitMeasure>& limits) {
  const CampaignVariant& baseline = campaign.variants[campaign.baseline];
  std::vector<VariantStatistics> all;
  for (const CampaignVariant& variant : campaign.variants) {
    VariantStatistics s;
    s.runs = campaign.seeds.size();
    for (const CampaignRun& run : variant.runs) ++(run.done ? s.done : s.failed);
    s.missing = s.runs - s.done - s.failed;
    s.measures.push_back(share_statistics_of("failed", failures_of(variant), failures_of(baseline), s));
    all.push_back(std::move(s));
  }
  for (const std::string& measure : measure_names(campaign)) {
    const BySeed reference = values_of(baseline, measure);
    for (std::size_t v = 0; v < all.size(); ++v)
      all[v].measures.push_back(
          statistics_of(measure, values_of(campaign.variants[v], measure), reference, all[v]));
  }
  for (const LimitMeasure& limit : limits) {
    const bool known = is_known_to_any(campaign, limit.base);
    for (std::size_t v = 0; v < all.size(); ++v)
      all[v].measures.push_back(share_statistics_of(limit.name,
                                                    successes_of(campaign.variants[v], limit, known),
                                                    successes_of(baseline, limit, known), all[v]));
  }
  return all;
}

}  // namespace incognita
