// True camera poses from files that lie beside a recording.
#pragma once

#include <filesystem>
#include <vector>

#include "incognita/io/recordings/recording.hpp"

namespace incognita {

/// Lines of `t x y z qx qy qz qw` (TUM RGB-D benchmark), in time order. Throws InputError naming file and line.
std::vector<RecordedPose> read_tum_poses(const std::filesystem::path& file);

/// world_from_camera as 4x4 or 3x4 matrices, rows one after the other, one per image: each on a line of 12 or 16 numbers, or on
/// four lines of 4; or, of a folder, each in a file of its own, in the natural order of their names. They get the times of
/// the images. Throws InputError naming file and line, and if their number is not that of the images.
std::vector<RecordedPose> read_matrix_poses(const std::filesystem::path& path,
                                            const std::vector<Recording::RecordedFrame>& frames);

/// Either of them, by the number of columns.
std::vector<RecordedPose> read_true_poses(const std::filesystem::path& path,
                                          const std::vector<Recording::RecordedFrame>& frames);

}  // namespace incognita
