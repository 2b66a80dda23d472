#include "incognita/record/run_directory.hpp"

#include <array>
#include <system_error>

#include "incognita/messages/errors.hpp"
#include "incognita/record/files/folders.hpp"
#include "incognita/record/files/row_file.hpp"

namespace incognita {
namespace fs = std::filesystem;
namespace {

constexpr std::array run_files{"effective.toml", "summary.json",
                               "estimate.tum",   "truth.tum",
                               "covariance.csv", "actions.csv",
                               "map.csv",        "map.ply",
                               "series.csv",     "interventions.jsonl",
                               "vehicles.csv",   "timings.csv",
                               "series.mat",     "run.mcap",
                               "surveyed.csv",   "measurements.csv",
                               "adjusted.tum",   "adjusted-whole.tum",
                               "run.state",      "replay.toml",
                               "looks.csv"};  // the last: earlier versions

/// Whether the name is prefix, `digits` or more digits, suffix.
bool is_numbered(std::string_view name, std::string_view prefix, std::string_view suffix,
                 std::size_t digits) {
  if (!name.starts_with(prefix) || !name.ends_with(suffix)) return false;
  if (name.size() < prefix.size() + digits + suffix.size()) return false;
  const std::string_view number = name.substr(prefix.size(), name.size() - prefix.size() - suffix.size());
  return number.find_first_not_of("0123456789") == std::string_view::npos;
}

/// frame-000123.png, see FramePictures and ImageRecording.
bool is_frame_picture(std::string_view name) { return is_numbered(name, "frame-", ".png", 6); }

/// Files from the second body on, see BodyTables.
bool is_of_vehicle(std::string_view name) {
  return is_numbered(name, "estimate-", ".tum", 1) || is_numbered(name, "truth-", ".tum", 1) ||
         is_numbered(name, "covariance-", ".csv", 1) || is_numbered(name, "actions-", ".csv", 1);
}

void remove_where(const fs::path& folder, bool (*is_ours)(std::string_view)) {
  std::error_code ignored;
  std::vector<fs::path> found;
  for (fs::directory_iterator it(folder, ignored), end; !ignored && it != end; it.increment(ignored))
    if (is_ours(it->path().filename().string())) found.push_back(it->path());
  for (const fs::path& file : found) fs::remove(file, ignored);
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
  try {  // before any file of an earlier run is removed
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
  for (const char* figure : {"map", "errors", "entropy", "decision", "vehicles", "control"})
    for (const char* suffix : {".svg", ".gp"})
      fs::remove(file("figures") / (std::string(figure) + suffix), ignored);
  remove_where(file("frames"), is_frame_picture);
  remove_where(file("recording") / "rgb", is_frame_picture);
  for (const char* table : {"rgb.txt", "groundtruth.txt"}) fs::remove(file("recording") / table, ignored);
  remove_where(path_, is_of_vehicle);
  for (const char* folder : {"figures", "frames", "recording/rgb", "recording"})
    fs::remove(file(folder), ignored);  // only if empty
}

void RunDirectory::discard() noexcept {
  remove_run_files();
  remove_empty(created_);
}

}  // namespace incognita
