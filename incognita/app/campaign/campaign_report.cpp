#include "incognita/app/campaign/campaign_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "incognita/app/campaign/requested_measures.hpp"
#include "incognita/app/console/print_message.hpp"
#include "incognita/messages/errors.hpp"
#include "incognita/record/files/durable_file.hpp"
#include "incognita/report/campaign_figure.hpp"
#include "incognita/report/campaign_table.hpp"

namespace incognita {
namespace {

constexpr std::size_t most_shown = 20;

/// The measures shown on a terminal by default.
constexpr const char* worth_reporting[] = {"failed",
                                           "exploration.diverged",
                                           "ate_m",
                                           "mean_nees",
                                           "mean_nis",
                                           "lost_frames",
                                           "entropy.total",
                                           "exploration.entropy_extended",
                                           "landmarks",
                                           "exploration.t_90_mapped_s",
                                           "exploration.mapped_60_s",
                                           "exploration.mapped",
                                           "map_error_m",
                                           "exploration.within_5_cm",
                                           "exploration.within_3_sigma"};

Campaign gather(const CampaignPlan& plan, const CampaignFolder& folder) {
  Campaign campaign{plan.scenario_name, INCOGNITA_VERSION, plan.seeds, {}, plan.baseline};
  for (const Variant& variant : plan.variants)
    campaign.variants.push_back({variant.name, {variant.varied.begin(), variant.varied.end()}, {}});
  std::set<std::string> programs;
  for (std::size_t run = 0; run < plan.runs(); ++run) {  // by increasing seed within each variant
    const auto result = folder.read(run);
    if (!result) continue;
    programs.insert(result->program);
    CampaignRun one{plan.seed_of(run), result->status == "done", result->reason, result->seconds, {}};
    if (!result->summary_json.empty()) one.measured = measures_of(result->summary_json);
    campaign.variants[run % plan.variants.size()].runs.push_back(std::move(one));
  }
  if (programs.size() > 1)
    print_message("the runs were made by {} builds of this program, whose results may differ\n",
                  programs.size());
  return campaign;
}

bool same(const Measures& a, const Measures& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& x, const auto& y) {
    return x.first == y.first && (x.second == y.second || (std::isnan(x.second) && std::isnan(y.second)));
  });
}

/// Warns if all seeds give identical results, as for a recording without randomness: more runs are then no
/// more evidence.
void warn_of_unused_seeds(const Campaign& campaign) {
  for (const CampaignVariant& variant : campaign.variants) {
    const auto as_the_first = [&](const CampaignRun& run) {
      return run.done && same(run.measured.measures, variant.runs.front().measured.measures);
    };
    if (variant.runs.size() > 1 && std::all_of(variant.runs.begin(), variant.runs.end(), as_the_first))
      print_message("{}: every seed gave the same result, so that its intervals are meaningless\n",
                    variant.name);
  }
}

std::vector<std::string> all_names(const Campaign& campaign) {
  std::vector<std::string> names = measure_names(campaign);
  names.insert(names.begin(), "failed");
  return names;
}

/// The default measures that are informative for this campaign.
std::vector<std::string> shown(const std::vector<VariantStatistics>& statistics) {
  std::vector<std::string> names;
  for (const char* name : worth_reporting)
    for (const VariantStatistics& s : statistics) {
      const bool known = std::any_of(s.measures.begin(), s.measures.end(), [&](const MeasureStatistics& m) {
        return m.measure == name && m.n > 0;
      });
      if (known && (names.empty() || names.back() != name)) names.emplace_back(name);
    }
  return names;
}

/// Draws the measures that the terminal shows.
void draw_figure(const CampaignFolder& folder, const Plot& plot) {
  if (plot.panels.empty()) return;
  std::vector<std::string> warnings;
  draw_plot(folder.path(), plot, &warnings);
  for (const std::string& warning : warnings) print_message("{}\n", warning);
}

void print_text(const Campaign& campaign, const std::vector<VariantStatistics>& statistics,
                const std::vector<std::string>& measures) {
  fmt::print("{}", table_text(campaign, statistics, measures));
  std::size_t failed = 0;
  for (const CampaignVariant& variant : campaign.variants)
    for (const CampaignRun& run : variant.runs) {
      if (run.done || ++failed > most_shown) continue;
      fmt::print("{}{}, seed {}: {}\n",
                 failed == 1 ? "\nfailed, and excluded above except from counts of failures:\n" : "",
                 variant.name, run.seed, run.reason);
    }
  if (failed > most_shown) fmt::print("and {} more: runs.csv\n", failed - most_shown);
  if (failed > 0 && limit_measures(measures).empty())
    fmt::print(
        "Means without failed runs favor a variant that fails on hard seeds; a limit counts all runs, e.g. --measure ate_m.below:0.1\n");
}

}  // namespace

int report_campaign(const CampaignPlan& plan, const CampaignFolder& folder, const ReportOptions& options) {
  const Campaign campaign = gather(plan, folder);
  std::size_t ended = 0;
  for (const CampaignVariant& variant : campaign.variants) ended += variant.runs.size();
  if (ended == 0) {
    print_message("incognita: none of the {} runs has been made yet\n", plan.runs());
    return 1;
  }
  const std::vector<std::string> names = all_names(campaign);
  if (const std::string problem = unknown_measure(base_names(options.measures), names); !problem.empty())
    throw InputError(problem);
  warn_of_unused_seeds(campaign);
  const std::vector<VariantStatistics> statistics = statistics_of(campaign, limit_measures(options.measures));
  const std::vector<std::string>& in_files = options.measures.empty() ? names : options.measures;
  const std::string json = campaign_json(campaign, statistics, in_files);
  write_durably(folder.path() / "runs.csv", runs_csv(campaign));
  write_durably(folder.path() / "timings.csv", timings_csv(campaign));
  write_durably(folder.path() / "table.csv", table_csv(campaign, statistics, in_files));
  write_durably(folder.path() / "campaign.json", json);
  const std::vector<std::string> on_terminal =
      options.measures.empty() ? shown(statistics) : options.measures;
  draw_figure(folder, campaign_figure(campaign, statistics, on_terminal));
  if (options.json)
    fmt::print("{}", json);
  else
    print_text(campaign, statistics, on_terminal);
  print_message("{} measures in {}\n", in_files.size(), (folder.path() / "table.csv").string());
  if (ended == plan.runs()) return 0;
  print_message("incognita: {} of {} runs are missing; the same command without --table makes them\n",
                plan.runs() - ended, plan.runs());
  return 1;
}

}  // namespace incognita
