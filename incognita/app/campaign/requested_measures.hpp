// Detects requested measures that no run can provide, as early as possible.
#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <vector>

#include "incognita/app/campaign/campaign_folder.hpp"

namespace incognita {

/// The measures of a run are known once it has ended, and variants may differ in them. A name is therefore
/// reported as unknown once every variant has a completed run and no run has the measure; failed runs may
/// lack measures.
class RequestedMeasures {
 public:
  /// Adds the runs already in the folder.
  RequestedMeasures(const std::vector<std::string>& names, const CampaignPlan& plan,
                    const CampaignFolder& folder);

  void add(std::size_t run, const RunResult& result);

  /// Message about the first requested measure that no run has; empty if there is none.
  std::string problem() const;

 private:
  std::vector<std::string> names_;
  std::size_t variants_ = 0;
  std::set<std::size_t> silent_;  ///< variants without a completed run
  std::vector<std::string> known_ = {"failed"};
};

/// Message about the first requested name that is not among the known ones; empty if there is none.
std::string unknown_measure(const std::vector<std::string>& requested, const std::vector<std::string>& known);

}  // namespace incognita
