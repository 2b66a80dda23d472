// What a simulated robot did: robot.csv, with each step, and truth.tum, with the true pose of the camera at each image.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <optional>

#include "incognita/app/robot/simulated_robot.hpp"
#include "incognita/record/files/row_file.hpp"

namespace incognita {

class RobotLog {
 public:
  static constexpr const char* columns = "t,state,command_t,speed_m_s,turn_rate_rad_s,x_m,y_m,heading_rad";

  /// `keeps`: rows that an earlier robot wrote there are kept. Throws RecordError if the folder cannot be written.
  RobotLog(const std::filesystem::path& folder, bool keeps);

  /// `start_s`: the robot's clock at its time 0, s since 1970.
  void add_step(const RobotState& state, double start_s);
  void add_image(const RobotState& state, double stamp_s);
  void flush();

 private:
  RowFile steps_, truth_;
};

/// The pose of the axle, x, y, heading, in the last complete row of a robot.csv. None without one. Throws InputError for a row
/// that has no such numbers.
std::optional<Eigen::Vector3d> last_pose(const std::filesystem::path& folder);

}  // namespace incognita
