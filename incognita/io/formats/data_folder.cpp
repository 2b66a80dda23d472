#include "incognita/io/formats/data_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <system_error>

#include "incognita/io/formats/files.hpp"
#include "incognita/messages/errors.hpp"

namespace incognita {
namespace {

struct Published {
  const char* folder;
  const char* where;
};

// docs/data.md describes these data sets and their checksums.
constexpr Published known[] = {
    {"monoslam_testseq",
     "It is published at www.doc.ic.ac.uk/~ajd/Scene/Release/testseqmonoslam.tar.gz (credit: A. J. Davison); "
     "put the\n"
     "1000 images in monoslam_testseq/frames. SHA-256 of rawoutput0000.pgm:\n"
     "3b3d604b6d5f0edbb20296548a6c1a5e47a19c61d7fe951434b37513a77580e8"},
    {"acfr_car_park",
     "It was made for the SLAM summer school 2002 (credit: J. Nieto, J. Guivant, E. Nebot, ACFR,\n"
     "University of Sydney); a copy is at github.com/yuzehai1995/hwork_SLAM in hw4_slam/. Put data_set.mat\n"
     "and beac_juan3.mat in acfr_car_park. SHA-256 of data_set.mat:\n"
     "f44c8adfa7e8e38ea6c40da3cd5d52bd8e029fc2d5ea27a9d7df24ad4ec98be7"},
    {"mrclam",
     "It is published at asrl.utias.utoronto.ca/datasets/mrclam (credit: K. Leung, Y. Halpern, T. Barfoot,\n"
     "H. Liu); unpack each set into a folder of its own, e.g. mrclam/MRCLAM_Dataset7."},
    {"chessboard_calibration",
     "It is published with OpenCV, in samples/data of github.com/opencv/opencv. Put left01.jpg to left14.jpg in\n"
     "chessboard_calibration. SHA-256 of left01.jpg:\n"
     "9621899098adffa1440c8264606bb7be535ccfd9ad126ae8e0bd9b0c5a5b8676"},
};

std::string publication(const std::string& path) {
  const std::string first = std::filesystem::path(path).begin()->string();
  for (const Published& one : known) {
    if (first == one.folder) return std::string("\n") + one.where + "\nSee docs/data.md.";
  }
  return "\nSee docs/data.md for where recordings are published and how they are laid out.";
}

/// INCOGNITA_DATA; empty if unset.
std::string chosen_folder() {
  const char* chosen = std::getenv("INCOGNITA_DATA");
  return chosen ? chosen : "";
}

std::string remedy() {
  if (chosen_folder().empty()) return "Put it under data/, or set INCOGNITA_DATA to the folder that has it.";
  return "INCOGNITA_DATA is set, so that only this folder, and that of the scenario, is searched: put it there, set INCOGNITA_DATA to "
         "the "
         "folder that has it, or unset it to use data/.";
}

}  // namespace

void add_place(const std::filesystem::path& place, std::vector<std::filesystem::path>& places) {
  const auto normal = [](const std::filesystem::path& path) {
    return std::filesystem::absolute(path).lexically_normal();
  };
  const bool is_there = std::any_of(places.begin(), places.end(),
                                    [&](const auto& other) { return normal(other) == normal(place); });
  if (!is_there) places.push_back(place);
}

std::vector<std::filesystem::path> data_folders(const std::filesystem::path& scenario_file) {
  if (const std::string chosen = chosen_folder(); !chosen.empty()) return {chosen};
  std::vector<std::filesystem::path> folders = {"data", "../shared/data"};
  if (!scenario_file.empty() && !is_embedded(scenario_file)) {
    const std::filesystem::path above = std::filesystem::absolute(scenario_file).parent_path().parent_path();
    add_place(above / "data", folders);
    add_place((above / "../shared/data").lexically_normal(), folders);
  }
  return folders;
}

std::filesystem::path find_data(const std::string& path, const std::filesystem::path& scenario_file,
                                const std::string& wanted_by) {
  std::error_code ignored;
  if (path.empty()) throw InputError(wanted_by + ": the path is empty");
  if (std::filesystem::path(path).is_absolute()) {
    if (std::filesystem::exists(path, ignored)) return path;
    throw InputError(fmt::format("{}: {} does not exist", wanted_by, path));
  }
  if (!scenario_file.empty() && !is_embedded(scenario_file))
    if (const auto beside = scenario_file.parent_path() / path; std::filesystem::exists(beside, ignored))
      return beside;
  std::string looked;
  for (const std::filesystem::path& folder : data_folders(scenario_file)) {
    if (std::filesystem::exists(folder / path, ignored)) return folder / path;
    looked += (looked.empty() ? "" : ", ") + (folder / path).string();
  }
  throw InputError(fmt::format("{}: {} is not in the data folder (searched: {}).\n{}{}", wanted_by, path,
                               looked, remedy(), publication(path)));
}

}  // namespace incognita
