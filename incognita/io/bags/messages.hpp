// The messages of ROS that recordings are made of: https://github.com/ros2/common_interfaces, and those of ROS 1, whose fields are
// the same, but for `seq` of the header.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "incognita/io/bags/message_cursor.hpp"

namespace incognita::bags {

struct Header {
  std::int64_t stamp_ns = 0;  ///< 0: none
  std::string frame;          ///< without the slash before it that early ROS 1 had
};

/// sensor_msgs/Image; `data` points into the bytes of the message.
struct ImageMessage {
  Header header;
  std::uint32_t height = 0, width = 0;  ///< px
  std::string encoding;                 ///< sensor_msgs/image_encodings.hpp: `mono8`, `bgr8`, ...
  bool is_big_endian = false;
  std::uint32_t step = 0;  ///< bytes of a row
  std::string_view data;
};

/// sensor_msgs/CompressedImage; `data` points into the bytes of the message.
struct CompressedImageMessage {
  Header header;
  std::string format;  ///< `jpeg`, `png`, or `bgr8; jpeg compressed bgr8`
  std::string_view data;
};

/// sensor_msgs/CameraInfo
struct CameraInfoMessage {
  Header header;
  std::uint32_t height = 0, width = 0;  ///< px
  std::string distortion_model;
  std::vector<double> d;
  std::array<double, 9> k{};   ///< row by row
  std::array<double, 12> p{};  ///< of the rectified image, row by row
  std::uint32_t binning_x = 0, binning_y = 0;
  std::uint32_t roi_x = 0, roi_y = 0, roi_height = 0, roi_width = 0;  ///< all 0: the whole image
};

/// The pose of `child` in `header.frame`, from any of the messages that state one.
struct PoseMessage {
  Header header;
  std::string child;                     ///< empty if the message does not say whose pose it is
  Eigen::Vector3d position{0, 0, 0};     ///< m
  Eigen::Vector4d rotation{1, 0, 0, 0};  ///< w, x, y, z, as in the message: perhaps no unit quaternion
};

/// Each throws MessageError if the message is shorter than its fields. Of a message whose end is missing the header can be read.
Header read_header(MessageCursor& cursor);
ImageMessage read_image(MessageCursor& cursor);
CompressedImageMessage read_compressed_image(MessageCursor& cursor);
CameraInfoMessage read_camera_info(MessageCursor& cursor);

/// geometry_msgs/PoseStamped and PoseWithCovarianceStamped, which begin alike.
PoseMessage read_pose(MessageCursor& cursor);
/// nav_msgs/Odometry
PoseMessage read_odometry(MessageCursor& cursor);
/// geometry_msgs/TransformStamped
PoseMessage read_transform(MessageCursor& cursor);
/// tf2_msgs/TFMessage and tf/tfMessage
std::vector<PoseMessage> read_transforms(MessageCursor& cursor);

}  // namespace incognita::bags
