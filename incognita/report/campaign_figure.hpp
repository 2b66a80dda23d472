// The means of a campaign as a figure: a panel per measure, a row per variant.
#pragma once

#include <string>
#include <vector>

#include "incognita/report/campaign_statistics.hpp"
#include "incognita/report/plot.hpp"

namespace incognita {

/// Means of `measures` with their 95 % intervals, `id` measures. The first variant is the uppermost row. Measures without a value in any
/// variant are left out; an interval that is not finite is not drawn.
Plot campaign_figure(const Campaign& campaign, const std::vector<VariantStatistics>& statistics,
                     const std::vector<std::string>& measures);

}  // namespace incognita
