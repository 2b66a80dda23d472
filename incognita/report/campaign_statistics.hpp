// Many runs of several variants, as statistics: each variant by itself, and against the baseline seed by
// seed.
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
  bool done = false;   ///< else it failed: lost, refused, crashed
  std::string reason;  ///< why it failed
  double seconds = 0;
  RunMeasures measured;  ///< empty of a run that crashed
};

struct CampaignVariant {
  std::string name;
  std::vector<std::pair<std::string, std::string>> varied;  ///< key and value in TOML
  std::vector<CampaignRun> runs;                            ///< those that ended, by rising seed, none twice
};

struct Campaign {
  std::string scenario, version;
  std::vector<std::int64_t> seeds;
  std::vector<CampaignVariant> variants;
  std::size_t baseline = 0;
};

struct MeasureStatistics {
  std::string measure;
  std::size_t n = 0;        ///< runs that have a value, that is, are done; of `failed` and successes all
  std::size_t ended = 0;    ///< runs of the variant that ended, done or failed
  double share_failed = 0;  ///< of them; NaN when none ended
  Interval mean;  ///< by Student's t; of `failed` and successes, which are shares, by Wilson's score
  double median = 0;
  /// Against the baseline, over the seeds on which both have a value.
  PairedComparison versus_baseline;
  std::size_t pairs_left_out = 0;  ///< seeds that ended in both and have no value in one of them
};

struct VariantStatistics {
  std::size_t runs = 0, done = 0, failed = 0, missing = 0;
  /// Of every measure that any run of the campaign has, in one order for all variants. The first is `failed`:
  /// 1 for a run that failed and 0 for one that is done, over all that ended. The last are the successes.
  std::vector<MeasureStatistics> measures;
};

/// One entry per variant. Depends on nothing but the runs: neither on their order nor on how they were
/// spread.
std::vector<VariantStatistics> statistics_of(const Campaign& campaign,
                                             const std::vector<LimitMeasure>& limits = {});

/// Names of all measures, in the order in which variants and seeds first have them.
std::vector<std::string> measure_names(const Campaign& campaign);
/// The same of timings.
std::vector<std::string> timing_names(const Campaign& campaign);

/// NaN when there is none of that name.
double value_of(const Measures& measures, const std::string& name);

}  // namespace incognita
