// The folder of a campaign: the results of its finished runs and the settings they belong to.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "incognita/app/campaign/campaign_plan.hpp"

namespace incognita {

/// A finished run. A run that crashed has no summary.
struct RunResult {
  std::string status;  ///< `done` or `failed`
  std::string reason;
  double seconds = 0;
  std::string summary_json;  ///< text of summary.json; empty if there is none
  std::string program;       ///< digest of the program that executed it
};

/// Run directory of a run; with `.json` appended, the file of its result.
std::filesystem::path run_directory(const std::filesystem::path& campaign, const CampaignPlan& plan,
                                    std::size_t run);

/// `runs/VARIANT/settings.json` holds the settings of a variant and `runs/VARIANT/seed-N.json` the result of
/// a run with its whole summary. Files are written durably, so existing ones are complete; a file that is not
/// a result of this plan is ignored and overwritten once its run has ended.
class CampaignFolder {
 public:
  /// Creates the folder. Throws InputError, without changing anything, if it contains runs with other
  /// settings, scenario or version (the message lists the differences), or if it cannot be written.
  CampaignFolder(std::filesystem::path path, const CampaignPlan& plan, const std::string& version);

  const std::filesystem::path& path() const { return path_; }

  bool has(std::size_t run) const;
  std::optional<RunResult> read(std::size_t run) const;
  /// Throws RecordError.
  void write(std::size_t run, const RunResult& result) const;

  /// Removes temporary files of killed writers.
  void tidy() const;
  /// Removes created folders that contain no result, for a campaign whose runs could not start.
  void discard_what_is_empty() const;

 private:
  void refuse_others() const;

  std::filesystem::path path_;
  const CampaignPlan& plan_;
  std::vector<std::filesystem::path> made_;  ///< folders that did not exist, outermost first
  std::vector<std::string> identities_;      ///< per variant: the text of settings.json
};

}  // namespace incognita
