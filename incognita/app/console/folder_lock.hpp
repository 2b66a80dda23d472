// Who writes to an output folder: one run, one `reproduce`, one campaign, or several shares of one campaign.
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

/// A share and the campaign that it is of: shares of the same campaign may work in one folder.
struct SharedCampaign {
  std::string digest;  ///< hexadecimal, the same for all shares of the campaign and for no other's
  Shard shard;
};

/// Keeps all others out of a folder, or as a share all but the other shares of the same campaign. A lock of
/// the kernel's on the file `.lock` in it, which goes with the process, however that ends, and which its
/// children do not have. Across machines where the file system has such locks there; where it has none, that
/// is said.
class FolderLock {
 public:
  /// Makes the folder. At once, with nothing changed, throws InputError when another process is at work in
  /// it, RecordError when it cannot be written to.
  explicit FolderLock(const std::filesystem::path& folder,
                      const std::optional<SharedCampaign>& share = std::nullopt);
  /// Lets go; the last one takes the file with it, and the folder where nothing else came to be in it.
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  std::filesystem::path file_;
  int descriptor_ = -1;
  std::vector<std::filesystem::path> made_;  ///< folders that were not there, the outermost first
};

}  // namespace incognita
