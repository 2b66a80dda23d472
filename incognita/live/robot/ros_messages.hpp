// The messages of ROS that the robot link uses, as rosbridge writes them in JSON. Both generations are read: a stamp is
// {"secs", "nsecs"} in ROS 1 and {"sec", "nanosec"} in ROS 2. Source: the definitions in common_msgs (ROS 1) and
// common_interfaces (ROS 2); uint8[] is base64, or a list of numbers: ROSBRIDGE_PROTOCOL.md, Section 4.6.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace incognita::ros {

inline constexpr const char* compressed_image_type = "sensor_msgs/CompressedImage";
inline constexpr const char* camera_info_type = "sensor_msgs/CameraInfo";
inline constexpr const char* odometry_type = "nav_msgs/Odometry";
inline constexpr const char* twist_type = "geometry_msgs/Twist";
inline constexpr const char* stamped_twist_type = "geometry_msgs/TwistStamped";
inline constexpr const char* bool_type = "std_msgs/Bool";

struct Header {
  std::int64_t stamp_ns = 0;  ///< since 1970, on the robot's clock
  std::string frame_id = {};
};

struct CompressedImage {
  Header header;
  std::string format;  ///< "jpeg", or e.g. "mono8; jpeg compressed "
  std::string data;    ///< bytes of the file
};

struct CameraInfo {
  Header header;
  int width = 0, height = 0;          ///< px
  std::string distortion_model = {};  ///< "plumb_bob", "equidistant", ...
  std::vector<double> distortion = {};
  std::array<double, 9> K{};  ///< row by row; fx, fy, cx, cy in px, of raw images
};

/// Velocity of a body in its own axes, x forward, y left, z up: m/s and rad/s.
struct Twist {
  Eigen::Vector3d linear{0, 0, 0}, angular{0, 0, 0};
};

struct Odometry {
  Header header;
  Eigen::Vector3d position{0, 0, 0};        ///< in the frame of the odometry, m
  Eigen::Vector4d orientation{1, 0, 0, 0};  ///< w x y z
  Twist twist = {};                         ///< in the axes of the body
};

struct StampedTwist {
  std::optional<std::int64_t> stamp_ns;  ///< none in a Twist, and in a TwistStamped whose publisher left it 0
  Twist twist;
};

// Each throws InputError that names the type and the field. Numbers must be finite.

CompressedImage compressed_image(std::string_view json);
CameraInfo camera_info(std::string_view json);
Odometry odometry(std::string_view json);
/// A Twist or a TwistStamped; fields that are missing are 0, as in ROS.
StampedTwist twist(std::string_view json);
bool boolean(std::string_view json);

// `ros`: generation, 1 or 2, whose names of fields are written.

std::string to_json(const CompressedImage& message, int ros);
std::string to_json(const CameraInfo& message, int ros);
std::string to_json(const Odometry& message, int ros);
/// A TwistStamped if there is a stamp, else a Twist.
std::string to_json(const StampedTwist& message, int ros);
std::string to_json(bool value);

}  // namespace incognita::ros
