// What a simulated robot did: robot.csv, with each step, and truth.tum, with the true pose of the camera at each image.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>

#include "incognita/app/robot/simulated_robot.hpp"

namespace incognita {

/// Rows that are added to a file, which another process may have begun and left in the middle of a row.
class AddedRows {
 public:
  /// `keeps`: complete rows that are there stay, and an incomplete last one is cut off; otherwise the file is emptied. A file
  /// without rows gets the header unless it is empty. Throws RecordError, and InputError for a file that begins with another line.
  AddedRows(std::filesystem::path path, std::string_view header, bool keeps);
  void add(std::string_view row);
  /// Passes all rows to the operating system. Throws RecordError, and leaves complete rows only.
  void flush();

 private:
  std::filesystem::path path_;
  std::ofstream out_;
};

class RobotLog {
 public:
  static constexpr const char* columns = "t,state,command_t,speed_m_s,turn_rate_rad_s,x_m,y_m,heading_rad";

  /// `keeps`: rows that an earlier robot wrote there are kept. Throws RecordError if the folder cannot be written, and InputError if its
  /// robot.csv is none.
  RobotLog(const std::filesystem::path& folder, bool keeps);

  /// `start_s`: the robot's clock at its time 0, s since 1970.
  void add_step(const RobotState& state, double start_s);
  void add_image(const RobotState& state, double stamp_s);
  void flush();

 private:
  AddedRows steps_, truth_;
};

/// The pose of the axle, x, y, heading, in the last complete row of a robot.csv. None without one. Throws InputError for a row
/// that has no such numbers.
std::optional<Eigen::Vector3d> last_pose(const std::filesystem::path& folder);

}  // namespace incognita
