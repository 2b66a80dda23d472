// Progress of a campaign on standard error.
#pragma once

#include <chrono>
#include <cstddef>
#include <string>

#include "incognita/app/campaign/campaign_folder.hpp"
#include "incognita/app/console/progress.hpp"

namespace incognita {

/// A changing line on a terminal, else a line every ten seconds. Every failed run is reported.
class CampaignProgress {
 public:
  CampaignProgress(const CampaignPlan& plan, std::size_t runs);

  void report(std::size_t run, const RunResult& result);
  /// Reports a run that has to be repeated.
  void report_trouble(std::size_t run, const std::string& why);

 private:
  const CampaignPlan& plan_;
  std::size_t runs_, ended_ = 0, failed_ = 0;
  Progress line_;
  std::chrono::steady_clock::time_point reported_;
};

}  // namespace incognita
