// The tables of a campaign, machine-readable and as text.
#pragma once

#include <string>
#include <vector>

#include "incognita/report/campaign_statistics.hpp"

namespace incognita {

/// A row per run that ended: variant, seed, status, reason and every measure; `nan` for a missing value.
std::string runs_csv(const Campaign& campaign);

/// A row per run that ended: variant, seed, seconds and the time of each stage. The only table that is not
/// reproducible.
std::string timings_csv(const Campaign& campaign);

/// A row per variant and listed measure.
std::string table_csv(const Campaign& campaign, const std::vector<VariantStatistics>& statistics,
                      const std::vector<std::string>& measures);

/// The document of docs/schemas/campaign.schema.json.
std::string campaign_json(const Campaign& campaign, const std::vector<VariantStatistics>& statistics,
                          const std::vector<std::string>& measures);

/// The table for a terminal.
std::string table_text(const Campaign& campaign, const std::vector<VariantStatistics>& statistics,
                       const std::vector<std::string>& measures);

}  // namespace incognita
