// What a campaign found, into its folder and on standard output.
#pragma once

#include <string>
#include <vector>

#include "incognita/app/campaign/campaign_folder.hpp"

namespace incognita {

struct ReportOptions {
  std::vector<std::string> measures;  ///< for the tables; empty: all in files, a few on the terminal
  bool json = false;                  ///< on standard output
};

/// Writes runs.csv, timings.csv, table.csv and campaign.json from the runs that have ended, and prints the
/// table. 0 when all have, else 1 and how many are missing. Throws InputError for a measure that no run has.
int report_campaign(const CampaignPlan& plan, const CampaignFolder& folder, const ReportOptions& options);

}  // namespace incognita
