// One run of a campaign: made in a process of its own, and what is to be thought of how that ended.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

#include "incognita/app/campaign/campaign_folder.hpp"
#include "incognita/app/campaign/process_pool.hpp"

namespace incognita {

/// What became of a run.
struct RunEnd {
  std::optional<RunResult> result;  ///< nothing: it has to be repeated
  std::string trouble;              ///< why it has to be
  bool bad_input = false;           ///< the trouble is with a file or setting: no repetition will help
};

/// The same loop as `incognita run`, without figures. Keeps the run directory where one is named, else
/// nothing but the summary. The answer is for end_of_run(), perhaps on another machine.
std::string make_run(const CampaignPlan& plan, std::size_t run,
                     const std::optional<std::filesystem::path>& keep);

/// The answer of who cannot make any run.
std::string no_run(const std::string& why);

/// A run that crashed has failed, and that is a result. One that was killed from outside has not: who kills,
/// or runs out of memory, says nothing about the run.
std::string answer_of(const JobEnd& end);
RunEnd end_of_run(const std::string& answer);

}  // namespace incognita
