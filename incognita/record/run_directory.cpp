#include "incognita/record/run_directory.hpp"

#include <algorithm>
#include <array>
#include <system_error>

#include "incognita/messages/errors.hpp"
#include "incognita/record/row_file.hpp"

namespace incognita {
namespace fs = std::filesystem;
namespace {

constexpr std::array run_files{"effective.toml", "summary.json", "estimate.tum", "truth.tum",
                               "covariance.csv", "actions.csv",  "map.csv",      "map.ply",
                               "series.csv",     "looks.csv",    "timings.csv",  "series.mat",
                               "run.mcap"};

/// The folders on the way to `path` that are not there, the outermost first.
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

/// Removes files of a folder that start and end with these words, and the folder when that leaves it empty.
void remove_matching(const fs::path& folder, std::string_view prefix,
                     std::initializer_list<std::string_view> suffixes) {
  std::error_code ignored;
  std::vector<fs::path> found;
  for (fs::directory_iterator it(folder, ignored), end; !ignored && it != end; it.increment(ignored)) {
    const std::string name = it->path().filename().string();
    for (const std::string_view suffix : suffixes)
      if (name.starts_with(prefix) && name.ends_with(suffix)) found.push_back(it->path());
  }
  for (const fs::path& file : found) fs::remove(file, ignored);
  fs::remove(folder, ignored);
}

}  // namespace

RunDirectory::RunDirectory(fs::path path) : path_(fs::absolute(path).lexically_normal()) {
  if (!path_.has_filename()) path_ = path_.parent_path();  // "out/" is "out"
  created_ = missing_folders(path_);
  std::error_code error;
  fs::create_directories(path_, error);
  if (!error && !fs::is_directory(path_)) error = std::make_error_code(std::errc::not_a_directory);
  if (error) {
    remove_empty(created_);
    throw RecordError(write_failure(path_, error.value()));
  }
  try {  // before anything of an earlier run is touched
    write_whole_file(file(".incognita-probe"), "can this folder be written to?\n");
  } catch (const RecordError&) {
    remove_empty(created_);
    throw;
  }
  fs::remove(file(".incognita-probe"), error);
  remove_run_files();
}

void RunDirectory::remove_run_files() noexcept {
  std::error_code ignored;
  for (const char* name : run_files) fs::remove(file(name), ignored);
  for (const char* figure : {"map", "errors", "entropy", "advice"})
    remove_matching(file("figures"), figure, {".svg", ".gp"});
  remove_matching(file("frames"), "frame-", {".png"});
}

void RunDirectory::discard() noexcept {
  remove_run_files();
  remove_empty(created_);
}

}  // namespace incognita
