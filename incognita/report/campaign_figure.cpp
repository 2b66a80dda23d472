#include "incognita/report/campaign_figure.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace incognita {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

std::string without_quotes(const std::string& value) {
  const bool quoted = value.size() >= 2 && value.front() == '"' && value.back() == '"';
  return quoted ? value.substr(1, value.size() - 2) : value;
}

/// Without the section: `decision.strategy` as `strategy`.
std::string last_part(const std::string& key) { return key.substr(key.find('.') + 1); }

std::vector<std::string> keys_of(const CampaignVariant& variant) {
  std::vector<std::string> keys;
  for (const auto& [key, value] : variant.varied) keys.push_back(key);
  return keys;
}

/// Whether all variants are values of the same settings, which then stand in the title and not in each row.
bool share_keys(const Campaign& campaign) {
  return std::ranges::all_of(campaign.variants, [&](const CampaignVariant& variant) {
    return !variant.varied.empty() && keys_of(variant) == keys_of(campaign.variants.front());
  });
}

std::string row_name(const CampaignVariant& variant, bool keys_in_title) {
  if (variant.varied.empty()) return variant.name;
  std::vector<std::string> parts;
  for (const auto& [key, value] : variant.varied)
    parts.push_back((keys_in_title ? "" : last_part(key) + "=") + without_quotes(value));
  return fmt::format("{}", fmt::join(parts, keys_in_title ? ", " : " "));
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
  const bool keys_in_title = share_keys(campaign);
  std::vector<std::string> rows;
  for (const CampaignVariant& variant : campaign.variants) rows.push_back(row_name(variant, keys_in_title));
  constexpr std::size_t narrow = 24;  // characters that leave room for two panels beside each other
  const bool fit = std::ranges::all_of(rows, [&](const std::string& row) { return row.size() <= narrow; });
  Plot plot{"measures", campaign.scenario, fit ? 2 : 1, {}};
  if (keys_in_title)
    plot.title += fmt::format(", by {}", fmt::join(keys_of(campaign.variants.front()), ", "));
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
