// Calibrations of one key and its numbers per line: KITTI's, and `fx 420.5`.
//
// KITTI odometry, calib.txt: `P0: ` and twelve numbers, a 3x4 projection matrix of rectified images, without their size; raw data,
// calib_cam_to_cam.txt: `P_rect_00: ` and `S_rect_00: ` (size). A. Geiger et al., IJRR 2013.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>

#include "incognita/io/calibrations/calibration_readers.hpp"
#include "incognita/io/calibrations/kitti_projection.hpp"
#include "incognita/io/formats/files.hpp"
#include "incognita/math/nearest_name.hpp"
#include "incognita/messages/errors.hpp"

namespace incognita {
namespace {

struct KeyLine {
  std::string key;
  std::vector<std::string> words;
  int number = 0;
};

/// Lines without comments (`#`); a colon or an equals sign after the key is left out.
std::vector<KeyLine> lines_of(const std::string& text) {
  std::vector<KeyLine> found;
  std::istringstream lines(text);
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    std::istringstream words(line.substr(0, line.find('#')));
    KeyLine entry{"", {}, number};
    if (!(words >> entry.key)) continue;
    for (std::string word; words >> word;)
      if (word != "=" && word != ":") entry.words.push_back(word);
    while (!entry.key.empty() && (entry.key.back() == ':' || entry.key.back() == '=')) entry.key.pop_back();
    found.push_back(entry);
  }
  return found;
}

const KeyLine* line_of(const std::vector<KeyLine>& lines, const std::string& key) {
  const auto at =
      std::find_if(lines.begin(), lines.end(), [&](const KeyLine& line) { return line.key == key; });
  return at == lines.end() ? nullptr : &*at;
}

[[noreturn]] void refuse(const std::filesystem::path& file, const KeyLine& line, const std::string& why) {
  throw InputError(fmt::format("{}:{}: {} {}", shown(file), line.number, line.key.substr(0, 60), why));
}

std::vector<double> numbers_of(const std::filesystem::path& file, const KeyLine& line, std::size_t count) {
  std::vector<double> numbers;
  for (std::string word : line.words) {
    if (word.ends_with(',')) word.pop_back();  // between numbers, as some write them
    if (word.empty()) continue;
    char* end = nullptr;
    const double number = std::strtod(word.c_str(), &end);
    if (*end != '\0' || !std::isfinite(number))
      refuse(file, line, fmt::format("must be followed by finite numbers, and has `{}`", word.substr(0, 60)));
    numbers.push_back(number);
  }
  if (numbers.size() != count)
    refuse(file, line,
           fmt::format("must be followed by {} number{}, and has {}", count, count == 1 ? "" : "s",
                       numbers.size()));
  return numbers;
}

bool is_projection(const std::string& key) {
  return (key.size() == 2 && key[0] == 'P' && key[1] >= '0' && key[1] <= '9') || key.starts_with("P_rect_");
}

KittiProjection projection_in(const std::filesystem::path& file, const KeyLine& line) {
  const std::vector<double> numbers = numbers_of(file, line, 12);
  KittiProjection P;
  std::copy(numbers.begin(), numbers.end(), P.data());
  if (!(P(0, 0) > 0 && P(1, 1) > 0))
    refuse(file, line,
           fmt::format("must have focal lengths of more than 0, and has {} and {}", P(0, 0), P(1, 1)));
  return P;
}

/// Row by row, without the last column.
std::vector<double> matrix_of(const KittiProjection& P) {
  return {P(0, 0), P(0, 1), P(0, 2), P(1, 0), P(1, 1), P(1, 2), P(2, 0), P(2, 1), P(2, 2)};
}

}  // namespace

bool is_kitti(const std::string& text) {
  const std::vector<KeyLine> lines = lines_of(text);
  return std::any_of(lines.begin(), lines.end(), [](const KeyLine& line) { return is_projection(line.key); });
}

std::optional<KittiProjection> kitti_projection(const std::filesystem::path& file, const std::string& name) {
  const std::vector<KeyLine> lines = lines_of(read_file(file, largest_calibration));
  const KeyLine* line = line_of(lines, name);
  return line ? std::optional(projection_in(file, *line)) : std::nullopt;
}

CalibrationFile read_kitti(const std::string& text, const std::filesystem::path& file,
                           const CalibrationRequest& request) {
  const std::vector<KeyLine> lines = lines_of(text);
  std::vector<std::string> cameras;
  for (const KeyLine& line : lines)
    if (is_projection(line.key)) cameras.push_back(line.key);
  const std::string name = request.camera.empty() ? cameras.front() : request.camera;
  const KeyLine* line = is_projection(name) ? line_of(lines, name) : nullptr;
  if (!line)
    throw InputError(fmt::format("{}: {} is none of the cameras of the file ({})", shown(file), name,
                                 fmt::join(cameras, ", ")));
  CalibrationFile found{CalibrationFormat::kitti, {file, {}, ""}, {}};
  CameraSettings& camera = found.calibrated.camera;
  const std::string wrong = set_matrix(camera, matrix_of(projection_in(file, *line)));
  if (!wrong.empty()) {  // no reason to refuse the images of a recording: the scenario may give the camera
    found.calibrated.unfit = fmt::format("line {}: {} without its last column {}", line->number, name, wrong);
    return found;
  }
  set_lens(camera, false, {});  // rectified images
  std::optional<std::pair<double, double>> size;
  if (name.starts_with("P_rect_"))
    if (const KeyLine* with_size = line_of(lines, "S_rect_" + name.substr(7))) {
      const std::vector<double> both = numbers_of(file, *with_size, 2);
      size = {both[0], both[1]};
    }
  set_size(camera, file, size, request);
  if (cameras.size() > 1)
    found.notes.push_back(
        fmt::format("has {} cameras ({}); {} is taken", cameras.size(), fmt::join(cameras, ", "), name));
  return found;
}

bool is_plain(const std::string& text) {
  const std::vector<KeyLine> lines = lines_of(text);
  return line_of(lines, "fx") && line_of(lines, "cx");
}

CalibrationFile read_plain(const std::string& text, const std::filesystem::path& file,
                           const CalibrationRequest& request) {
  CalibrationFile found{CalibrationFormat::plain, {file, {}, ""}, {}};
  const std::vector<std::string> keys = {"fx", "fy", "cx", "cy",    "k1",    "k2",
                                         "p1", "p2", "k3", "width", "height"};
  std::vector<double> values(keys.size(), NAN);
  for (const KeyLine& line : lines_of(text)) {
    const auto key = std::find(keys.begin(), keys.end(), line.key);
    if (key == keys.end())
      refuse(file, line, fmt::format("is no such key; the nearest is `{}`", nearest_name(line.key, keys)));
    double& value = values[static_cast<std::size_t>(key - keys.begin())];
    if (!std::isnan(value)) refuse(file, line, "is given twice");
    value = numbers_of(file, line, 1).front();
  }
  for (std::size_t i = 0; i < 4; ++i)
    if (std::isnan(values[i])) throw InputError(fmt::format("{}: {} is missing", shown(file), keys[i]));
  CameraSettings& camera = found.calibrated.camera;
  camera.fu_px = values[0], camera.fv_px = values[1], camera.u0_px = values[2], camera.v0_px = values[3];
  std::vector<double> distortion(values.begin() + 4, values.begin() + 9);
  for (double& k : distortion) k = std::isnan(k) ? 0 : k;
  set_lens(camera, false, distortion);
  const bool sized = !std::isnan(values[9]) && !std::isnan(values[10]);
  set_size(camera, file, sized ? std::optional(std::pair(values[9], values[10])) : std::nullopt, request);
  return found;
}

}  // namespace incognita
