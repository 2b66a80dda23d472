#include "incognita/app/robot/robot_log.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

#include "incognita/messages/errors.hpp"

namespace incognita {
namespace {

/// Lines that end with a line break: the last one of a robot that was killed may not.
std::vector<std::string> whole_lines(const std::filesystem::path& file) {
  std::vector<std::string> found;
  std::ifstream in(file, std::ios::binary);
  for (std::string line; std::getline(in, line) && !in.eof();) found.push_back(line);
  return found;
}

RowFile opened(const std::filesystem::path& file, const char* header, bool keeps) {
  const std::vector<std::string> before = keeps ? whole_lines(file) : std::vector<std::string>{};
  RowFile rows(file, header);
  for (const std::string& line : before)
    if (line != header) rows.append(line, 0);
  rows.flush();
  return rows;
}

std::filesystem::path made(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw RecordError(write_failure(folder, error.value()));
  return folder;
}

}  // namespace

RobotLog::RobotLog(const std::filesystem::path& folder, bool keeps)
    : steps_(opened(made(folder) / "robot.csv", columns, keeps)),
      truth_(opened(folder / "truth.tum", "", keeps)) {}

void RobotLog::add_step(const RobotState& s, double start_s) {
  const std::string command_t = s.command_t ? fmt::format("{:.6f}", start_s + *s.command_t) : "";
  steps_.append(fmt::format("{:.6f},{},{},{:.6f},{:.6f},{:.6f},{:.6f},{:.6f}", start_s + s.t, name(s.reason),
                            command_t, s.executed[0], s.executed[1], s.pose[0], s.pose[1], s.pose[2]),
                s.t);
}

void RobotLog::add_image(const RobotState& s, double stamp_s) {
  const Eigen::Vector3d& p = s.camera.position;
  const Eigen::Vector4d& q = s.camera.world_from_body;
  truth_.append(fmt::format("{:.6f} {:.6f} {:.6f} {:.6f} {:.8f} {:.8f} {:.8f} {:.8f}", stamp_s, p.x(), p.y(),
                            p.z(), q[1], q[2], q[3], q[0]),
                s.t);
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
