// The results of `incognita reproduce` or `incognita campaign` in a folder, as the files that the page may read.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

namespace incognita {

/// A file as it is sent to the page.
struct ServedFile {
  std::string content_type;
  std::string bytes;
};

class Laboratory {
 public:
  enum class Kind { claims, campaign };

  /// Throws InputError unless the folder has exactly one of claims.json and campaign.json. Files larger than
  /// `largest_file` bytes are not read.
  explicit Laboratory(const std::filesystem::path& folder, std::size_t largest_file = std::size_t{64} << 20);

  Kind kind() const { return kind_; }
  /// The word of `GET /api/mode`: `claims` or `campaign`.
  const char* kind_name() const { return kind_ == Kind::claims ? "claims" : "campaign"; }

  /// The file of that name, relative to the folder, with slashes: `claims.json`, `campaign.json`, `runs.csv`,
  /// `figures/*.svg`, `figures/*.csv`. Empty for any other name, for a file that does not exist, and for a link
  /// that leads out of the folder. Throws InputError if the file is too large or cannot be read.
  std::optional<ServedFile> file(const std::string& name) const;

 private:
  std::filesystem::path folder_;  ///< absolute, without symbolic links
  std::size_t largest_file_;
  Kind kind_;
};

}  // namespace incognita
