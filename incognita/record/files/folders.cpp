#include "incognita/record/files/folders.hpp"

#include <algorithm>
#include <system_error>

namespace incognita {
namespace fs = std::filesystem;

std::vector<fs::path> missing_folders(const fs::path& path) {
  std::vector<fs::path> missing;
  std::error_code error;
  for (fs::path p = path; !p.empty() && !fs::exists(p, error) && !error; p = p.parent_path())
    missing.push_back(p);
  std::reverse(missing.begin(), missing.end());
  return missing;
}

void remove_empty(const std::vector<fs::path>& folders) noexcept {
  std::error_code ignored;
  for (auto folder = folders.rbegin(); folder != folders.rend(); ++folder) fs::remove(*folder, ignored);
}

}  // namespace incognita
