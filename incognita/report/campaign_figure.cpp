#include "incognita/report/campaign_figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace incognita {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Where a single setting differs its key stands in the title.
std::string row_name(const CampaignVariant& variant) {
  if (variant.varied.size() != 1) return variant.name;
  const std::string& value = variant.varied.front().second;
  const bool quoted = value.size() >= 2 && value.front() == '"' && value.back() == '"';
  return quoted ? value.substr(1, value.size() - 2) : value;
}

std::string title_of(const Campaign& campaign) {
  const auto& varied = campaign.variants.front().varied;
  return varied.size() == 1 ? fmt::format("{}, by {}", campaign.scenario, varied.front().first)
                            : campaign.scenario;
}

const MeasureStatistics* find(const VariantStatistics& of, const std::string& measure) {
  const auto found = std::ranges::find(of.measures, measure, &MeasureStatistics::measure);
  return found == of.measures.end() || found->n == 0 ? nullptr : &*found;
}

Panel panel_of(const std::vector<VariantStatistics>& statistics, const std::string& measure) {
  Curve means{"", Style::circles, {}, {}}, intervals{"", Style::line, {}, {}};
  for (std::size_t i = 0; i < statistics.size(); ++i) {
    const MeasureStatistics* of = find(statistics[i], measure);
    if (!of || !std::isfinite(of->mean.value)) continue;
    const auto row = static_cast<double>(statistics.size() - 1 - i);
    means.x.push_back(of->mean.value);
    means.y.push_back(row);
    if (!std::isfinite(of->mean.low) || !std::isfinite(of->mean.high)) continue;
    intervals.x.insert(intervals.x.end(), {of->mean.low, of->mean.high, nan});
    intervals.y.insert(intervals.y.end(), {row, row, nan});
  }
  means.color = intervals.color = Color::blue;
  Panel panel;
  panel.title = measure;
  panel.x_label = "mean and its 95 % interval";
  panel.curves = {std::move(intervals), std::move(means)};
  panel.y_range = {-0.6, static_cast<double>(statistics.size()) - 0.4};
  return panel;
}

}  // namespace

Plot campaign_figure(const Campaign& campaign, const std::vector<VariantStatistics>& statistics,
                     const std::vector<std::string>& measures) {
  Plot plot{"measures", title_of(campaign), 2, {}};
  std::vector<std::string> rows;
  for (const CampaignVariant& variant : campaign.variants) rows.push_back(row_name(variant));
  std::ranges::reverse(rows);
  for (const std::string& measure : measures) {
    Panel panel = panel_of(statistics, measure);
    if (panel.curves.back().x.empty()) continue;
    panel.y_names = rows;
    plot.panels.push_back(std::move(panel));
  }
  return plot;
}

}  // namespace incognita
