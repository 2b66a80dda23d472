// A synthetic recording of a team in MRCLAM's layout: two robots drive side by side along x, detect two
// landmarks and each other, and motion capture has a gap for each of them.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

#include "tests/scratch.hpp"

namespace incognita::testing {

struct Gap {
  double from_s = 0, to_s = 0;  ///< both excluded
  bool has(double t_s) const { return t_s > from_s && t_s < to_s; }
};

struct GeneratedTeam {
  double speed_m_s = 0.5, duration_s = 10, step_s = 0.1;
  std::vector<Gap> without_truth{{5, 8}, {2, 4}};  ///< one per robot
  Gap wheel_slip{5, 8};                            ///< of robot 1: its odometry is 50 % too high meanwhile
  int see_every = 5;                               ///< steps

  int steps() const { return static_cast<int>(std::lround(duration_s / step_s)); }
  double y_m(std::size_t robot) const { return robot == 0 ? 0 : 2; }
  double true_x_m(double t_s) const { return speed_m_s * t_s; }

  void write(const Scratch& scratch, const std::string& folder) const {
    scratch.write(folder + "/Barcodes.dat", "1 11\n2 12\n6 16\n7 17\n");
    scratch.write(folder + "/Landmark_Groundtruth.dat", "6 3 1 0 0\n7 6 1.5 0 0\n");
    for (std::size_t robot = 0; robot < 2; ++robot) write_robot(scratch, folder, robot);
  }

 private:
  void write_robot(const Scratch& scratch, const std::string& folder, std::size_t robot) const {
    std::string odometry, seen, truth;
    for (int k = 0; k <= steps(); ++k) {
      const double t = k * step_s;
      const double said = robot == 0 && wheel_slip.has(t) ? 1.5 * speed_m_s : speed_m_s;
      odometry += fmt::format("{:.2f} {} 0\n", t, said);
      if (!without_truth[robot].has(t)) truth += fmt::format("{:.2f} {} {} 0\n", t, true_x_m(t), y_m(robot));
      if (k % see_every != 0) continue;
      seen += detection(robot, t, 16, 3, 1);
      seen += detection(robot, t, 17, 6, 1.5);
      seen += detection(robot, t, robot == 0 ? 12 : 11, true_x_m(t), y_m(1 - robot));
    }
    const std::string name = fmt::format("{}/Robot{}_", folder, robot + 1);
    scratch.write(name + "Odometry.dat", odometry);
    scratch.write(name + "Measurement.dat", seen);
    scratch.write(name + "Groundtruth.dat", truth);
  }

  std::string detection(std::size_t robot, double t, int barcode, double x_m, double y_of_it_m) const {
    const double dx = x_m - true_x_m(t), dy = y_of_it_m - y_m(robot);
    return fmt::format("{:.2f} {} {:.9f} {:.9f}\n", t, barcode, std::hypot(dx, dy), std::atan2(dy, dx));
  }
};

}  // namespace incognita::testing
