// One reader per layout of a recording. See read_recording().
#pragma once

#include "incognita/io/recordings/recording.hpp"

namespace incognita {

/// A folder of images, taken in the natural order of their names (img2 before img10), at a steady rate. Those
/// of two cameras side by side are refused, unless a pattern chooses among them.
Recording read_image_folder(const std::filesystem::path& folder, double rate_hz, const std::string& pattern);

/// The TUM RGB-D benchmark: rgb.txt (`stamp file`) and, if there, groundtruth.txt (`t x y z qx qy qz qw`),
/// the pose of the optical frame.
Recording read_tum(const std::filesystem::path& folder);
bool looks_like_tum(const std::filesystem::path& folder);

/// EuRoC MAV, given the folder that has mav0/, or mav0 itself: cam0/data.csv and, if there,
/// state_groundtruth_estimate0/data.csv, the body's pose, made the camera's with T_BS of cam0/sensor.yaml.
Recording read_euroc(const std::filesystem::path& folder);
bool looks_like_euroc(const std::filesystem::path& folder);
/// Of cam0/sensor.yaml alone; nothing where there is none.
std::optional<CalibratedCamera> camera_in_euroc(const std::filesystem::path& folder);

}  // namespace incognita
