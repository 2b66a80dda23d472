// Writes the results of a campaign into its folder and to standard output.
#pragma once

#include <string>
#include <vector>

#include "incognita/app/campaign/campaign_folder.hpp"

namespace incognita {

struct ReportOptions {
  std::vector<std::string> measures;  ///< for the tables; empty: all in files, a selection on the terminal
  bool json = false;                  ///< JSON on standard output
};

/// Writes runs.csv, timings.csv, table.csv, campaign.json and figures/measures.svg from the finished runs, and prints the table.
/// Returns 0 if all runs have finished, else 1 after reporting how many are missing. Throws InputError for a
/// measure that no run has.
int report_campaign(const CampaignPlan& plan, const CampaignFolder& folder, const ReportOptions& options);

}  // namespace incognita
