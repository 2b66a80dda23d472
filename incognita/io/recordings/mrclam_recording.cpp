#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "incognita/io/formats/files.hpp"
#include "incognita/io/formats/number_table.hpp"
#include "incognita/io/recordings/range_formats.hpp"
#include "incognita/io/recordings/range_recording_builder.hpp"
#include "incognita/messages/errors.hpp"

namespace incognita {
namespace {

constexpr int robots = 5;  // subjects 1 to 5; the landmarks follow
constexpr const char* barcode_file = "Barcodes.dat";
constexpr const char* landmark_file = "Landmark_Groundtruth.dat";

using Subjects = std::map<std::int64_t, std::int64_t>;  ///< by barcode

std::filesystem::path robot_file(const std::filesystem::path& folder, int robot, const char* what) {
  return folder / fmt::format("Robot{}_{}.dat", robot, what);
}

std::int64_t whole_number(const TableLine& line, std::size_t i) {
  const double value = line.number(i);
  if (value >= 0 && value < 1e9 && value == std::floor(value)) return static_cast<std::int64_t>(value);
  throw InputError(fmt::format("{}: column {} must be a whole number from 0, and is `{}`", line.where, i + 1,
                               line.text(i)));
}

Subjects read_subjects(const std::filesystem::path& file) {
  Subjects subjects;
  for (const TableLine& line : read_table(file)) {
    const std::int64_t subject = whole_number(line, 0), barcode = whole_number(line, 1);
    if (!subjects.emplace(barcode, subject).second) {
      throw InputError(fmt::format("{}: barcode {} is already that of subject {}", line.where, barcode,
                                   subjects[barcode]));
    }
  }
  if (subjects.empty()) throw InputError(fmt::format("{}: lists no barcodes", file.string()));
  return subjects;
}

void read_odometry(const std::filesystem::path& file, RangeRecordingBuilder& recording) {
  for (const TableLine& line : read_table(file)) {
    recording.add_odometry(line.where, {line.number(0), {line.number(1), line.number(2)}});
  }
}

/// Reads the measurements of `robot`. `members`: robot numbers of a team in order; empty for a single robot.
void read_measurements(const std::filesystem::path& file, const Subjects& subjects, int robot,
                       const std::vector<int>& members, RangeRecordingBuilder& recording) {
  for (const TableLine& line : read_table(file)) {
    recording.add_scan(line.where, line.number(0));
    const auto subject = subjects.find(whole_number(line, 1));
    const Detection detection{line.number(2), line.number(3), Detection::unknown};
    if (subject == subjects.end()) {
      recording.skip(fmt::format("measurements of barcodes that are not in {} are skipped", barcode_file),
                     line.where);
    } else if (subject->second == robot) {
      recording.skip("measurements of the robot's own barcode are skipped", line.where);
    } else if (subject->second <= robots) {
      const auto other = std::find(members.begin(), members.end(), subject->second);
      if (other == members.end())
        recording.skip("measurements of other robots are omitted", line.where);
      else
        recording.add_vehicle_detection(line.where,
                                        {detection.range_m, detection.bearing_rad, other - members.begin()});
    } else {
      recording.add_detection(line.where, {detection.range_m, detection.bearing_rad, subject->second});
    }
  }
}

void read_truth(const std::filesystem::path& file, RangeRecordingBuilder& recording) {
  if (!file_exists(file)) {
    recording.note(fmt::format("there is no {}: the truth is unknown", file.filename().string()));
    return;
  }
  for (const TableLine& line : read_table(file)) {
    recording.add_truth(line.where, {line.number(0), {line.number(1), line.number(2)}, line.number(3)});
  }
}

void read_landmarks(const std::filesystem::path& file, RangeRecordingBuilder& recording) {
  if (!file_exists(file)) {
    recording.note(fmt::format("there is no {}: there are no surveyed landmarks", landmark_file));
    return;
  }
  for (const TableLine& line : read_table(file)) {
    recording.add_landmark(line.where, {whole_number(line, 0), {line.number(1), line.number(2)}});
  }
}

std::vector<int> robots_in(const std::filesystem::path& folder) {
  std::vector<int> there;
  for (int robot = 1; robot <= robots; ++robot)
    if (file_exists(robot_file(folder, robot, "Odometry"))) there.push_back(robot);
  return there;
}

void check_robot(const std::filesystem::path& folder, int robot) {
  if (robot < 1 || robot > robots) {
    throw InputError(fmt::format("recording.robot = {}: must be 1 to {}", robot, robots));
  }
  if (file_exists(robot_file(folder, robot, "Odometry"))) return;
  const std::vector<int> there = robots_in(folder);
  throw InputError(fmt::format("{}: does not exist; {}", robot_file(folder, robot, "Odometry").string(),
                               there.empty()
                                   ? "there is no odometry of any robot"
                                   : fmt::format("there is odometry of robot {}", fmt::join(there, ", "))));
}

RangeRecording read_robot(const std::filesystem::path& folder, int robot, const std::vector<int>& members) {
  RangeRecordingBuilder recording("mrclam", "differential-drive");
  const Subjects subjects = read_subjects(folder / barcode_file);
  read_odometry(robot_file(folder, robot, "Odometry"), recording);
  read_measurements(robot_file(folder, robot, "Measurement"), subjects, robot, members, recording);
  read_truth(robot_file(folder, robot, "Groundtruth"), recording);
  read_landmarks(folder / landmark_file, recording);
  return recording.finish(fmt::format("{}: robot {}", folder.string(), robot));
}

}  // namespace

bool looks_like_mrclam(const std::filesystem::path& folder) { return file_exists(folder / barcode_file); }

RangeRecording read_mrclam(const std::filesystem::path& folder, int robot) {
  check_robot(folder, robot);
  return read_robot(folder, robot, {});
}

std::vector<RangeRecording> read_mrclam_team(const std::filesystem::path& folder) {
  const std::vector<int> members = robots_in(folder);
  if (members.empty()) check_robot(folder, 1);
  std::vector<RangeRecording> team;
  team.reserve(members.size());
  for (const int robot : members) team.push_back(read_robot(folder, robot, members));
  return team;
}

}  // namespace incognita
