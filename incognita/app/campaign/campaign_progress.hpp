// How far a campaign is, on standard error.
#pragma once

#include <chrono>
#include <cstddef>
#include <string>

#include "incognita/app/campaign/campaign_folder.hpp"
#include "incognita/app/console/progress.hpp"

namespace incognita {

/// On a terminal a line that changes; elsewhere a line every ten seconds. Each run that failed is named.
class CampaignProgress {
 public:
  CampaignProgress(const CampaignPlan& plan, std::size_t runs);

  void report(std::size_t run, const RunResult& result);
  /// A run that has to be repeated.
  void report_trouble(std::size_t run, const std::string& why);

 private:
  const CampaignPlan& plan_;
  std::size_t runs_, ended_ = 0, failed_ = 0;
  Progress line_;
  std::chrono::steady_clock::time_point reported_;
};

}  // namespace incognita
