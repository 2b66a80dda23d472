// Monte Carlo statistics of a campaign: per variant, and paired by seed with the baseline.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "incognita/analysis/evaluation/statistics.hpp"
#include "incognita/report/campaign_limit.hpp"
#include "incognita/report/campaign_measures.hpp"

namespace incognita {

struct CampaignRun {
  std::int64_t seed = 0;
  bool done = false;   ///< else it failed: lost, refused or crashed
  std::string reason;  ///< why it failed
  double seconds = 0;
  RunMeasures measured;  ///< empty for a run that crashed
};

struct CampaignVariant {
  std::string name;
  std::vector<std::pair<std::string, std::string>> varied;  ///< key and value in TOML
  std::vector<CampaignRun> runs;  ///< runs that ended, by increasing seed, without duplicates
};

struct Campaign {
  std::string scenario, version;
  std::vector<std::int64_t> seeds;
  std::vector<CampaignVariant> variants;
  std::size_t baseline = 0;
};

struct MeasureStatistics {
  std::string measure;
  std::size_t n = 0;        ///< completed runs with a value; all that ended for `failed` and successes
  std::size_t ended = 0;    ///< runs of the variant that ended, completed or failed
  double share_failed = 0;  ///< among `ended`; NaN if none ended
  Interval mean;            ///< Student's t interval; Wilson score for shares (`failed`, successes)
  double median = 0;
  /// Difference to the baseline over the seeds for which both have a value.
  PairedComparison versus_baseline;
  std::size_t pairs_left_out = 0;  ///< seeds ended in both, but without a value in one
};

struct VariantStatistics {
  std::size_t runs = 0, done = 0, failed = 0, missing = 0;
  /// All measures of all runs in the campaign, in the same order for each variant. The first is `failed` (1
  /// for a failed run, 0 for a completed one, over all that ended), the last are the successes.
  std::vector<MeasureStatistics> measures;
};

/// One entry per variant. Depends on the runs only, not on their order or distribution over processes.
std::vector<VariantStatistics> statistics_of(const Campaign& campaign,
                                             const std::vector<LimitMeasure>& limits = {});

/// Names of all measures, in order of first occurrence over variants and seeds.
std::vector<std::string> measure_names(const Campaign& campaign);
/// Names of all timings, in the same order.
std::vector<std::string> timing_names(const Campaign& campaign);

/// The value of that name, else NaN.
double value_of(const Measures& measures, const std::string& name);

}  // namespace incognita
