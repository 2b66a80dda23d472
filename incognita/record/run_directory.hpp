// The folder of one run: created if missing, left unchanged if the run cannot start.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace incognita {

/// Files of an earlier run in the same folder are removed first: only files with names that a run writes,
/// including frame pictures and figures.
class RunDirectory {
 public:
  /// Throws RecordError, leaving nothing behind, if the folder cannot be created or written.
  explicit RunDirectory(std::filesystem::path path);

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path file(const std::string& file_name) const { return path_ / file_name; }

  /// Removes all files of the run and the folders created for it, for a run that could not start.
  void discard() noexcept;

 private:
  void remove_run_files() noexcept;

  std::filesystem::path path_;
  std::vector<std::filesystem::path> created_;  ///< folders that did not exist, outermost first
};

}  // namespace incognita
