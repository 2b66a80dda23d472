// Whether the measures that were asked for can still come, said as soon as it is known.
#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <vector>

#include "incognita/app/campaign/campaign_folder.hpp"

namespace incognita {

/// What a run measures is known when it has ended, and another variant may measure something else. So a name
/// is unknown once every variant has a run that is done, and no run has it; a run that failed may lack what
/// others have.
class RequestedMeasures {
 public:
  /// Takes in the runs that the folder has.
  RequestedMeasures(const std::vector<std::string>& names, const CampaignPlan& plan,
                    const CampaignFolder& folder);

  void add(std::size_t run, const RunResult& result);

  /// What is to be said of the first name that nothing is to be expected of; empty: there is none.
  std::string problem() const;

 private:
  std::vector<std::string> names_;
  std::size_t variants_ = 0;
  std::set<std::size_t> silent_;  ///< variants of which no run is done
  std::vector<std::string> known_ = {"failed"};
};

/// Of the first of the wanted that is not among the known; empty: there is none.
std::string unknown_measure(const std::vector<std::string>& requested, const std::vector<std::string>& known);

}  // namespace incognita
