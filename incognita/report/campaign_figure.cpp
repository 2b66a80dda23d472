#include "incognita/report/campaign_figure.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace incognita {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

std::string without_quotes(const std::string& value) {
  const bool quoted = value.size() >= 2 && value.front() == '"' && value.back() == '"';
  return quoted ? value.substr(1, value.size() - 2) : value;
}

/// Without the section: `decision.strategy` as `strategy`.
std::string last_part(const std::string& key) { return key.substr(key.find('.') + 1); }

/// The settings in which the variants differ: not those that all of them change to the same value. A variant that changes nothing,
/// the scenario as it is, does not count.
std::vector<std::string> differing_keys(const Campaign& campaign) {
  std::map<std::string, std::vector<std::string>> values;
  std::size_t changed = 0;
  for (const CampaignVariant& variant : campaign.variants) {
    changed += !variant.varied.empty();
    for (const auto& [key, value] : variant.varied) values[key].push_back(value);
  }
  std::vector<std::string> differing;
  for (const auto& [key, of] : values) {
    const bool same =
        of.size() == changed && std::ranges::all_of(of, [&](const auto& v) { return v == of[0]; });
    if (!same || values.size() == 1) differing.push_back(key);
  }
  return differing;
}

/// Whether all variants that change something change all of `keys`, which then stand in the title and not in each row.
bool share(const Campaign& campaign, const std::vector<std::string>& keys) {
  return !keys.empty() && std::ranges::all_of(campaign.variants, [&](const CampaignVariant& variant) {
    return variant.varied.empty() || std::ranges::all_of(keys, [&](const std::string& key) {
             return std::ranges::find(variant.varied, key, [](const auto& varied) { return varied.first; }) !=
                    variant.varied.end();
           });
  });
}

std::string row_name(const CampaignVariant& variant, const std::vector<std::string>& keys,
                     bool keys_in_title) {
  std::vector<std::string> parts;
  for (const auto& [key, value] : variant.varied)
    if (std::ranges::find(keys, key) != keys.end())
      parts.push_back((keys_in_title ? "" : last_part(key) + "=") + without_quotes(value));
  return parts.empty() ? variant.name : fmt::format("{}", fmt::join(parts, keys_in_title ? ", " : " "));
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
  const std::vector<std::string> keys = differing_keys(campaign);
  const bool keys_in_title = share(campaign, keys);
  std::vector<std::string> rows;
  for (const CampaignVariant& variant : campaign.variants)
    rows.push_back(row_name(variant, keys, keys_in_title));
  constexpr std::size_t narrow = 24;  // characters that leave room for two panels beside each other
  const bool fit = std::ranges::all_of(rows, [&](const std::string& row) { return row.size() <= narrow; });
  Plot plot{"measures", campaign.scenario, fit ? 2 : 1, {}};
  if (keys_in_title) plot.title += fmt::format(", by {}", fmt::join(keys, ", "));
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
