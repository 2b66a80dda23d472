#include "incognita/record/snapshot/pose_rows.hpp"

#include <fmt/format.h>

#include "incognita/record/files/number.hpp"

namespace incognita {

std::string tum_row(const StampedPose& pose) {
  std::string row;
  append_number(row, pose.t);
  const Eigen::Vector3d& p = pose.position;
  const Eigen::Vector4d& q = pose.orientation;
  for (const double value : {p.x(), p.y(), p.z(), q[1], q[2], q[3], q[0]}) {
    row += ' ';
    append_number(row, value);
  }
  return row;
}

std::string tum_header(const std::string& body, bool oriented) {
  return "# t x y z qx qy qz qw, world_from_" + body + (oriented ? "" : "; the orientation is not known");
}

std::string covariance_row(double t, const PoseCovariance& P) {
  std::string row;
  append_number(row, t);
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) append_cell(row, P(i, j));
  return row;
}

std::string covariance_header() {
  constexpr const char* axes[] = {"x", "y", "z", "rotx", "roty", "rotz"};
  std::string header = "t";
  for (const char* row : axes)
    for (const char* column : axes) header += fmt::format(",{}_{}", row, column);
  return header;
}

}  // namespace incognita
