#include "incognita/app/robot/robot_log.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "incognita/messages/errors.hpp"
#include "incognita/record/files/row_file.hpp"

namespace incognita {
namespace {

/// Lines that end with a line break: the last one of a robot that was killed may not.
std::vector<std::string> whole_lines(const std::filesystem::path& file) {
  std::vector<std::string> found;
  std::ifstream in(file, std::ios::binary);
  for (std::string line; std::getline(in, line) && !in.eof();) found.push_back(line);
  return found;
}

/// Length in bytes of the lines that end with a line break. Throws RecordError for a file that cannot be read.
std::uintmax_t bytes_in_whole_lines(const std::filesystem::path& file) {
  std::uintmax_t bytes = 0;
  errno = 0;
  std::ifstream in(file, std::ios::binary);
  for (std::string line; std::getline(in, line) && !in.eof();) bytes += line.size() + 1;
  if (!in.is_open() || in.bad()) throw RecordError(write_failure(file, errno == 0 ? EIO : errno));
  return bytes;
}

void cut_incomplete_line(const std::filesystem::path& file) {
  std::error_code error;
  const std::uintmax_t whole = bytes_in_whole_lines(file);
  if (std::filesystem::file_size(file, error) != whole && !error)
    std::filesystem::resize_file(file, whole, error);
  if (error) throw RecordError(write_failure(file, error.value()));
}

/// Throws InputError for a file that does not begin with the header, whole or, if it has no other line, in part.
void check_header(const std::filesystem::path& file, std::string_view header) {
  std::string line;
  std::ifstream in(file, std::ios::binary);
  std::getline(in, line);
  if (line == header || (in.eof() && header.starts_with(line))) return;
  throw InputError(
      fmt::format("{}, line 1: must be {}; start the robot without --resume, or with another --out",
                  file.string(), header));
}

std::filesystem::path made(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw RecordError(write_failure(folder, error.value()));
  return folder;
}

}  // namespace

AddedRows::AddedRows(std::filesystem::path path, std::string_view header, bool keeps)
    : path_(std::move(path)) {
  if (keeps && std::filesystem::exists(path_)) {
    if (!header.empty()) check_header(path_, header);
    cut_incomplete_line(path_);
  }
  errno = 0;
  out_.open(path_, std::ios::binary | (keeps ? std::ios::app : std::ios::trunc));
  if (!out_) throw RecordError(write_failure(path_, errno));
  const bool is_empty = out_.seekp(0, std::ios::end).tellp() == 0;
  if (is_empty && !header.empty()) add(header);
  flush();
}

void AddedRows::add(std::string_view row) { out_ << row << '\n'; }

void AddedRows::flush() {
  errno = 0;
  if (out_.flush()) return;
  const int error = errno == 0 ? ENOSPC : errno;
  out_.close();
  cut_incomplete_line(path_);
  throw RecordError(write_failure(path_, error));
}

RobotLog::RobotLog(const std::filesystem::path& folder, bool keeps)
    : steps_(made(folder) / "robot.csv", columns, keeps), truth_(folder / "truth.tum", "", keeps) {}

void RobotLog::add_step(const RobotState& s, double start_s) {
  const std::string command_t = s.command_t ? fmt::format("{:.6f}", start_s + *s.command_t) : "";
  steps_.add(fmt::format("{:.6f},{},{},{:.6f},{:.6f},{:.6f},{:.6f},{:.6f}", start_s + s.t, name(s.reason),
                         command_t, s.executed[0], s.executed[1], s.pose[0], s.pose[1], s.pose[2]));
}

void RobotLog::add_image(const RobotState& s, double stamp_s) {
  const Eigen::Vector3d& p = s.camera.position;
  const Eigen::Vector4d& q = s.camera.world_from_body;
  truth_.add(fmt::format("{:.6f} {:.6f} {:.6f} {:.6f} {:.8f} {:.8f} {:.8f} {:.8f}", stamp_s, p.x(), p.y(),
                         p.z(), q[1], q[2], q[3], q[0]));
}

void RobotLog::flush() {
  steps_.flush();
  truth_.flush();
}

std::optional<Eigen::Vector3d> last_pose(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "robot.csv";
  const std::vector<std::string> lines = whole_lines(file);
  if (lines.size() < 2) return std::nullopt;
  const std::string& row = lines.back();
  Eigen::Vector3d pose;
  std::size_t begin = row.size() + 1;
  for (int fields = 0; fields < 3 && begin != 0; ++fields) begin = row.rfind(',', begin - 2) + 1;
  if (std::sscanf(row.c_str() + begin, "%lf,%lf,%lf", &pose[0], &pose[1], &pose[2]) != 3 || !pose.allFinite())
    throw InputError(
        fmt::format("{}, line {}: must end with x, y and heading; start the robot without --resume",
                    file.string(), lines.size()));
  return pose;
}

}  // namespace incognita
