// The tables of a campaign, for programs and for people.
#pragma once

#include <string>
#include <vector>

#include "incognita/report/campaign_statistics.hpp"

namespace incognita {

/// A row per run that ended: variant, seed, status, reason, and every measure; `nan` where there is no value.
std::string runs_csv(const Campaign& campaign);

/// A row per run that ended: variant, seed, seconds, and how long each stage of a frame took. Alone of these
/// tables in being another when the runs are repeated.
std::string timings_csv(const Campaign& campaign);

/// A row per variant and measure of the list.
std::string table_csv(const Campaign& campaign, const std::vector<VariantStatistics>& statistics,
                      const std::vector<std::string>& measures);

/// docs/schemas/campaign.schema.json
std::string campaign_json(const Campaign& campaign, const std::vector<VariantStatistics>& statistics,
                          const std::vector<std::string>& measures);

/// To be read on a terminal.
std::string table_text(const Campaign& campaign, const std::vector<VariantStatistics>& statistics,
                       const std::vector<std::string>& measures);

}  // namespace incognita
