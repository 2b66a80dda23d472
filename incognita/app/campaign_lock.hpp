// Who works in the folder of a campaign: one campaign, or shares of one.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace incognita {

/// One of so many shares of a campaign, from 0.
struct Shard {
  std::size_t which = 0, of = 1;
};

/// Keeps all others out of a folder, or as a share all but the other shares of the same plan. A lock of the
/// kernel's on a file in it, which goes with the process, however that ends, and which its children do not
/// have. Across machines where the file system has such locks there; where it has none, that is said.
class CampaignLock {
 public:
  /// Makes the folder. Throws InputError at once, with nothing changed, when another is at work in it or it
  /// cannot be written to.
  CampaignLock(const std::filesystem::path& folder, const std::string& plan_digest,
               const std::optional<Shard>& shard);
  /// Lets go; the last one takes the file with it, and the folder where nothing else came to be in it.
  ~CampaignLock();
  CampaignLock(const CampaignLock&) = delete;
  CampaignLock& operator=(const CampaignLock&) = delete;

 private:
  std::filesystem::path file_;
  int descriptor_ = -1;
  std::vector<std::filesystem::path> made_;  ///< folders that were not there, the outermost first
};

}  // namespace incognita
