// Exclusive access to an output folder: for one run, one `reproduce`, one campaign, or the shards of one campaign.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace incognita {

/// Shard `which` (from 0) of `of` shards of a campaign.
struct Shard {
  std::size_t which = 0, of = 1;
};

/// A shard and its campaign: shards of the same campaign may share a folder.
struct SharedCampaign {
  std::string digest;  ///< hexadecimal; identifies the campaign
  Shard shard;
};

/// Locks a folder against all other processes, or, for a shard, against all but the other shards of the same
/// campaign. The lock is a kernel lock on the file `.lock`, which is released when the process ends for
/// whatever reason and is not inherited by children. It works across machines if the file system supports it;
/// if locks are not supported at all, a warning is printed.
class FolderLock {
 public:
  /// Creates the folder. Does not wait: throws InputError if another process holds the lock and RecordError
  /// if the folder cannot be written, leaving everything unchanged.
  explicit FolderLock(const std::filesystem::path& folder,
                      const std::optional<SharedCampaign>& share = std::nullopt);
  /// Unlocks; the last owner removes the file, and the created folders if they are empty.
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  std::filesystem::path file_;
  int descriptor_ = -1;
  std::vector<std::filesystem::path> made_;  ///< folders that did not exist, outermost first
};

}  // namespace incognita
