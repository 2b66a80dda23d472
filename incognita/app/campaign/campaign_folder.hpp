// The folder of a campaign: what each finished run left, and whose runs they are.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "incognita/app/campaign/campaign_plan.hpp"

namespace incognita {

/// A run that ended by itself. One that crashed has no summary.
struct RunResult {
  std::string status;  ///< `done` or `failed`
  std::string reason;
  double seconds = 0;
  std::string summary_json;  ///< summary.json's text; empty: there is none
  std::string program;       ///< digest of the program that ran it
};

/// Where a run keeps its run directory, and with `.json` behind it what it left.
std::filesystem::path run_directory(const std::filesystem::path& campaign, const CampaignPlan& plan,
                                    std::size_t run);

/// Below the folder, `runs/VARIANT/settings.json` says what the variant is and `runs/VARIANT/seed-N.json` how
/// a run ended, with its whole summary. Each is written durably, so that whatever is there is whole; what is
/// not a result of this plan's is left out, and written over when its run has ended.
class CampaignFolder {
 public:
  /// Makes the folder. Throws InputError, with nothing changed, when runs of other settings, of another
  /// scenario or of another version are in it; says what differs. InputError too when it cannot be written
  /// to.
  CampaignFolder(std::filesystem::path path, const CampaignPlan& plan, const std::string& version);

  const std::filesystem::path& path() const { return path_; }

  bool has(std::size_t run) const;
  std::optional<RunResult> read(std::size_t run) const;
  /// Throws RecordError.
  void write(std::size_t run, const RunResult& result) const;

  /// Removes what killed writers left.
  void tidy() const;
  /// No run could start: what was made for them goes, where no result is in it.
  void discard_what_is_empty() const;

 private:
  void refuse_others() const;

  std::filesystem::path path_;
  const CampaignPlan& plan_;
  std::vector<std::filesystem::path> made_;  ///< folders that were not there, the outermost first
  std::vector<std::string> identities_;      ///< per variant: the text of settings.json
};

}  // namespace incognita
