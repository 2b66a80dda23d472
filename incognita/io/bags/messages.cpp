#include "incognita/io/bags/messages.hpp"

namespace incognita::bags {
namespace {

std::string frame_name(std::string_view name) {
  while (name.starts_with('/')) name.remove_prefix(1);
  return std::string(name);
}

template <std::size_t n>
void read_numbers(MessageCursor& cursor, std::array<double, n>& numbers) {
  for (double& number : numbers) number = cursor.number<double>();
}

/// Position, then the quaternion as x, y, z, w.
void read_pose_fields(MessageCursor& cursor, PoseMessage& pose) {
  for (const int i : {0, 1, 2}) pose.position[i] = cursor.number<double>();
  for (const int i : {1, 2, 3, 0}) pose.rotation[i] = cursor.number<double>();
}

}  // namespace

Header read_header(MessageCursor& cursor) {
  constexpr std::int64_t second = 1'000'000'000;
  if (cursor.serialization() == Serialization::ros1) cursor.number<std::uint32_t>();  // seq
  Header header;
  // Seconds are unsigned in ROS 1 and signed in ROS 2; equal until 2038
  const std::int64_t seconds = cursor.number<std::uint32_t>();
  header.stamp_ns = seconds * second + cursor.number<std::uint32_t>();
  header.frame = frame_name(cursor.text());
  return header;
}

ImageMessage read_image(MessageCursor& cursor) {
  ImageMessage image;
  image.header = read_header(cursor);
  image.height = cursor.number<std::uint32_t>();
  image.width = cursor.number<std::uint32_t>();
  image.encoding = cursor.text();
  image.is_big_endian = cursor.number<std::uint8_t>() != 0;
  image.step = cursor.number<std::uint32_t>();
  image.data = cursor.bytes();
  return image;
}

CompressedImageMessage read_compressed_image(MessageCursor& cursor) {
  CompressedImageMessage image;
  image.header = read_header(cursor);
  image.format = cursor.text();
  image.data = cursor.bytes();
  return image;
}

CameraInfoMessage read_camera_info(MessageCursor& cursor) {
  CameraInfoMessage info;
  info.header = read_header(cursor);
  info.height = cursor.number<std::uint32_t>();
  info.width = cursor.number<std::uint32_t>();
  info.distortion_model = cursor.text();
  info.d.resize(cursor.list_size(sizeof(double)));
  for (double& coefficient : info.d) coefficient = cursor.number<double>();
  std::array<double, 9> rectification{};
  read_numbers(cursor, info.k);
  read_numbers(cursor, rectification);
  read_numbers(cursor, info.p);
  for (std::uint32_t* field :
       {&info.binning_x, &info.binning_y, &info.roi_x, &info.roi_y, &info.roi_height, &info.roi_width})
    *field = cursor.number<std::uint32_t>();
  return info;
}

PoseMessage read_pose(MessageCursor& cursor) {
  PoseMessage pose;
  pose.header = read_header(cursor);
  read_pose_fields(cursor, pose);
  return pose;
}

/// Begins as a transform; covariance and velocity follow.
PoseMessage read_odometry(MessageCursor& cursor) { return read_transform(cursor); }

PoseMessage read_transform(MessageCursor& cursor) {
  PoseMessage pose;
  pose.header = read_header(cursor);
  pose.child = frame_name(cursor.text());
  read_pose_fields(cursor, pose);
  return pose;
}

std::vector<PoseMessage> read_transforms(MessageCursor& cursor) {
  constexpr std::size_t least_bytes = 72;  // of a transform: stamp, two texts, seven numbers, without `seq`
  std::vector<PoseMessage> transforms(cursor.list_size(least_bytes));
  for (PoseMessage& transform : transforms) transform = read_transform(cursor);
  return transforms;
}

}  // namespace incognita::bags
