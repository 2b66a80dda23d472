#include "incognita/record/map_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>

#include "incognita/record/files/number.hpp"
#include "incognita/record/files/row_file.hpp"

namespace incognita {
namespace {

/// 80 for sigma of 1 m or more, 230 for 1 cm or less (sigma: root of the covariance trace).
int gray(const SnapshotLandmark& landmark) {
  const double sigma_m = std::sqrt(std::max(landmark.covariance.trace(), 1e-12));
  return static_cast<int>(std::clamp(80 - 75 * std::log10(sigma_m), 80.0, 230.0));
}

}  // namespace

void write_map_csv(const std::filesystem::path& path, const std::vector<SnapshotLandmark>& landmarks) {
  std::string text = "id,kind,x,y,z,pxx,pxy,pxz,pyy,pyz,pzz,detections\n";
  for (const SnapshotLandmark& landmark : landmarks) {
    text += std::to_string(landmark.id);
    append_cell(text, landmark.anchor ? "anchor" : "landmark");
    for (const double p : landmark.position) append_cell(text, p);
    for (int i = 0; i < 3; ++i)
      for (int j = i; j < 3; ++j) append_cell(text, landmark.covariance(i, j));
    fmt::format_to(std::back_inserter(text), ",{}\n", landmark.detection_count);
  }
  write_whole_file(path, text);
}

void write_survey_csv(const std::filesystem::path& path, const std::vector<SurveyedLandmark>& landmarks) {
  std::string text = "id,x,y,z\n";
  for (const SurveyedLandmark& landmark : landmarks) {
    text += std::to_string(landmark.id);
    for (const double p : landmark.position) append_cell(text, p);
    text += '\n';
  }
  write_whole_file(path, text);
}

void write_map_ply(const std::filesystem::path& path, const std::vector<SnapshotLandmark>& landmarks) {
  std::string text = fmt::format(
      "ply\nformat ascii 1.0\ncomment landmarks of an incognita run, m, z up\nelement vertex {}\n"
      "property double x\nproperty double y\nproperty double z\n"
      "property uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n",
      landmarks.size());
  for (const SnapshotLandmark& landmark : landmarks) {
    const auto& p = landmark.position;
    const int g = gray(landmark);
    fmt::format_to(std::back_inserter(text), "{} {} {} ", p.x(), p.y(), p.z());
    text += landmark.anchor ? "255 140 0\n" : fmt::format("{} {} {}\n", g, g, g);
  }
  write_whole_file(path, text);
}

}  // namespace incognita
