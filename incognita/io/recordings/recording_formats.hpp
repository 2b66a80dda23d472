// One reader per recording format. See read_recording().
#pragma once

#include "incognita/io/recordings/recording.hpp"

namespace incognita {

/// A folder of images at a fixed rate, in natural order of their names (img2 before img10). Refuses images of
/// two cameras unless a pattern selects one.
Recording read_image_folder(const std::filesystem::path& folder, double rate_hz, const std::string& pattern);

/// TUM RGB-D benchmark: rgb.txt (`stamp file`) and, if present, groundtruth.txt (`t x y z qx qy qz qw`), the
/// pose of the optical frame.
Recording read_tum(const std::filesystem::path& folder);
bool looks_like_tum(const std::filesystem::path& folder);

/// EuRoC MAV, given mav0/ or its parent folder: cam0/data.csv and, if present,
/// state_groundtruth_estimate0/data.csv, the body pose, which is converted to the camera pose with T_BS of
/// cam0/sensor.yaml.
Recording read_euroc(const std::filesystem::path& folder);
bool looks_like_euroc(const std::filesystem::path& folder);
/// Reads cam0/sensor.yaml only; nullopt if it is missing.
std::optional<CalibratedCamera> camera_in_euroc(const std::filesystem::path& folder);

/// A sequence of the KITTI odometry benchmark: times.txt, image_0 to image_3, of which the first there is used, and, if
/// present, calib.txt and the true poses, poses.txt or ../../poses/NN.txt.
Recording read_kitti(const std::filesystem::path& folder);
bool looks_like_kitti(const std::filesystem::path& folder);
/// From calib.txt and the size of the first image; nullopt if there is none.
std::optional<CalibratedCamera> camera_in_kitti(const std::filesystem::path& folder);

/// An MCAP file, a bag of ROS 1, or the folder of a ROS 2 bag. The images are those of one topic, at the times of their headers,
/// else of the recorder; the truth is that of a topic of poses, or the pose of the camera in the transforms.
Recording read_bag(const std::filesystem::path& path, const BagTopics& topics);
bool looks_like_bag(const std::filesystem::path& path);
/// From the first CameraInfo of the camera that read_bag() uses; nullopt if there is none.
std::optional<CalibratedCamera> camera_in_bag(const std::filesystem::path& path, const BagTopics& topics);

}  // namespace incognita
