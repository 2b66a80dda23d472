// The folder of one run: made when it is not there, left as it was when the run cannot start.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace incognita {

/// Files of an earlier run in the same folder are removed first: those with the names a run directory has,
/// pictures of frames and figures included, and no others.
class RunDirectory {
 public:
  /// Throws RecordError, with nothing left behind, when the folder cannot be made or written to.
  explicit RunDirectory(std::filesystem::path path);

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path file(const std::string& file_name) const { return path_ / file_name; }

  /// Removes every file of the run, and the folders that were made for it: the run did not start after all.
  void discard() noexcept;

 private:
  void remove_run_files() noexcept;

  std::filesystem::path path_;
  std::vector<std::filesystem::path> created_;  ///< folders that were not there, the outermost first
};

}  // namespace incognita
