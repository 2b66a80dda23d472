// Executes one run of a campaign in a process of its own and interprets how it ended.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

#include "incognita/app/campaign/campaign_folder.hpp"
#include "incognita/app/campaign/process_pool.hpp"

namespace incognita {

/// The outcome of a run.
struct RunEnd {
  std::optional<RunResult> result;  ///< nullopt: the run has to be repeated
  std::string trouble;              ///< why it has to be repeated
  bool bad_input = false;           ///< caused by a file or setting: repeating does not help
};

/// Executes the same loop as `incognita run`, without figures. Keeps the run directory if `keep` names one,
/// else only the summary. The returned text is input to end_of_run(), possibly on another machine.
std::string make_run(const CampaignPlan& plan, std::size_t run,
                     const std::optional<std::filesystem::path>& keep);

/// The answer of a process that cannot execute any run.
std::string no_run(const std::string& why);

/// The answer for a job. A crash is a failed run and therefore a result; a run killed from outside (or out of
/// memory) is not, as this does not depend on the run.
std::string answer_of(const JobEnd& end);
RunEnd end_of_run(const std::string& answer);

}  // namespace incognita
