#include "incognita/report/campaign_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "incognita/math/unknown.hpp"
#include "incognita/record/files/number.hpp"

namespace incognita {
namespace {

using Json = nlohmann::ordered_json;

/// The word as the first cell of a row.
std::string first_cell(const std::string& word) {
  std::string row;
  append_cell(row, word);
  return row.substr(1);
}

/// An unbounded value is written as unknown.
double finite(double value) { return std::isfinite(value) ? value : unknown; }

void append_count(std::string& row, std::size_t count) { row += fmt::format(",{}", count); }

void append_cells(std::string& row, std::initializer_list<double> values) {
  for (const double value : values) append_cell(row, finite(value));
}

bool requested(const MeasureStatistics& m, const std::vector<std::string>& measures) {
  return std::find(measures.begin(), measures.end(), m.measure) != measures.end();
}

Json json_of(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json json_of(const MeasureStatistics& m, bool is_baseline) {
  Json json{{"n", m.n},
            {"ended", m.ended},
            {"share_failed", json_of(m.share_failed)},
            {"mean", json_of(m.mean.value)},
            {"low", json_of(m.mean.low)},
            {"high", json_of(m.mean.high)},
            {"median", json_of(m.median)}};
  if (is_baseline) return json;
  const PairedComparison& c = m.versus_baseline;
  json["versus_baseline"] = {{"pairs", c.pairs},
                             {"pairs_left_out", m.pairs_left_out},
                             {"difference", json_of(c.difference.value)},
                             {"low", json_of(c.difference.low)},
                             {"high", json_of(c.difference.high)},
                             {"share_lower", json_of(c.share_lower)},
                             {"share_higher", json_of(c.share_higher)}};
  return json;
}

std::string with_interval(const Interval& i) {
  if (!std::isfinite(i.value)) return "-";
  if (!std::isfinite(i.low) || !std::isfinite(i.high)) return fmt::format("{:.4g} (too few)", i.value);
  return fmt::format("{:.4g} ({:.4g} to {:.4g})", i.value, i.low, i.high);
}

std::string share(double value) { return std::isnan(value) ? "-" : fmt::format("{:.0f} %", 100 * value); }

std::string of(std::size_t count, std::size_t all) { return fmt::format("{} of {}", count, all); }

std::string text_row(const std::string& variant, std::size_t width, const MeasureStatistics& m,
                     bool is_baseline) {
  const std::string median = std::isnan(m.median) ? "-" : fmt::format("{:.4g}", m.median);
  std::string row = fmt::format("  {:<{}}  {:>9}  {:>6}  {:<32}  {:<10}", variant, width, of(m.n, m.ended),
                                share(m.share_failed), with_interval(m.mean), median);
  const PairedComparison& c = m.versus_baseline;
  row += is_baseline ? "  baseline"
                     : fmt::format("  {:<34}  {:>9}  {:>6}  {:>6}", with_interval(c.difference),
                                   of(c.pairs, c.pairs + m.pairs_left_out), share(c.share_lower),
                                   share(c.share_higher));
  return row + "\n";
}

}  // namespace

std::string runs_csv(const Campaign& campaign) {
  const std::vector<std::string> names = measure_names(campaign);
  std::string text = "variant,seed,status,reason";
  for (const std::string& name : names) append_cell(text, name);
  text += '\n';
  for (const CampaignVariant& variant : campaign.variants)
    for (const CampaignRun& run : variant.runs) {
      std::string row = first_cell(variant.name) + fmt::format(",{}", run.seed);
      append_cell(row, run.done ? "done" : "failed");
      append_cell(row, run.reason);
      for (const std::string& name : names) append_cell(row, finite(value_of(run.measured.measures, name)));
      text += row + "\n";
    }
  return text;
}

std::string timings_csv(const Campaign& campaign) {
  const std::vector<std::string> names = timing_names(campaign);
  std::string text = "variant,seed,seconds";
  for (const std::string& name : names) append_cell(text, name);
  text += '\n';
  for (const CampaignVariant& variant : campaign.variants)
    for (const CampaignRun& run : variant.runs) {
      std::string row = first_cell(variant.name) + fmt::format(",{}", run.seed);
      append_cell(row, run.seconds);
      for (const std::string& name : names) append_cell(row, value_of(run.measured.timings, name));
      text += row + "\n";
    }
  return text;
}

std::string table_csv(const Campaign& campaign, const std::vector<VariantStatistics>& statistics,
                      const std::vector<std::string>& measures) {
  std::string text =
      "variant,measure,n,ended,share_failed,mean,mean_low,mean_high,median,pairs,pairs_left_out,difference,"
      "difference_low,difference_high,share_lower,share_higher\n";
  for (std::size_t v = 0; v < statistics.size(); ++v)
    for (const MeasureStatistics& m : statistics[v].measures) {
      if (!requested(m, measures)) continue;
      std::string row = first_cell(campaign.variants[v].name);
      append_cell(row, m.measure);
      append_count(row, m.n);
      append_count(row, m.ended);
      append_cells(row, {m.share_failed, m.mean.value, m.mean.low, m.mean.high, m.median});
      const PairedComparison& c = m.versus_baseline;
      append_count(row, c.pairs);
      append_count(row, m.pairs_left_out);
      append_cells(row,
                   {c.difference.value, c.difference.low, c.difference.high, c.share_lower, c.share_higher});
      text += row + "\n";
    }
  return text;
}

std::string campaign_json(const Campaign& campaign, const std::vector<VariantStatistics>& statistics,
                          const std::vector<std::string>& measures) {
  Json json{{"scenario", campaign.scenario},  {"version", campaign.version},
            {"seeds", campaign.seeds},        {"baseline", campaign.variants[campaign.baseline].name},
            {"confidence", usual_confidence}, {"variants", Json::array()}};
  for (std::size_t v = 0; v < statistics.size(); ++v) {
    const CampaignVariant& variant = campaign.variants[v];
    const VariantStatistics& s = statistics[v];
    Json one{{"name", variant.name}, {"varied", Json::object()}, {"runs", s.runs},           {"done", s.done},
             {"failed", s.failed},   {"missing", s.missing},     {"failures", Json::array()}};
    for (const auto& [key, value] : variant.varied) one["varied"][key] = value;
    for (const CampaignRun& run : variant.runs)
      if (!run.done) one["failures"].push_back({{"seed", run.seed}, {"reason", run.reason}});
    Json& all = one["measures"] = Json::object();
    for (const MeasureStatistics& m : s.measures)
      if (requested(m, measures)) all[m.measure] = json_of(m, v == campaign.baseline);
    json["variants"].push_back(std::move(one));
  }
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string table_text(const Campaign& campaign, const std::vector<VariantStatistics>& statistics,
                       const std::vector<std::string>& measures) {
  std::size_t width = 8;
  for (const CampaignVariant& variant : campaign.variants) width = std::max(width, variant.name.size());
  std::string text;
  for (const std::string& measure : measures) {
    text += fmt::format("{}{:<{}}  {:>9}  {:>6}  {:<32}  {:<10}  {:<34}  {:>9}  {:>6}  {:>6}\n",
                        text.empty() ? "" : "\n", measure, width + 2, "runs", "failed", "mean (95 %)",
                        "median", "minus the baseline's (95 %)", "pairs", "lower", "higher");
    for (std::size_t v = 0; v < statistics.size(); ++v)
      for (const MeasureStatistics& m : statistics[v].measures)
        if (m.measure == measure)
          text += text_row(campaign.variants[v].name, width, m, v == campaign.baseline);
  }
  return text;
}

}  // namespace incognita
