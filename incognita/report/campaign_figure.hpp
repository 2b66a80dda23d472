// The means of a campaign as a figure: a panel per measure, a row per variant.
#pragma once

#include <string>
#include <vector>

#include "incognita/report/campaign_statistics.hpp"
#include "incognita/report/plot.hpp"

namespace incognita {

/// Means of `measures`, in their units, with their 95 % intervals. The first variant is the uppermost row. A measure without a value in
/// all variants is left out, and so is an interval that is not finite. `campaign` has a variant or more, `statistics` one entry for each.
Plot campaign_figure(const Campaign& campaign, const std::vector<VariantStatistics>& statistics,
                     const std::vector<std::string>& measures);

}  // namespace incognita
