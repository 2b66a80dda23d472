// JSON messages for viewers, named after Foxglove's schemas and laid out as in message_schemas.hpp.
// Orientations are world_from_camera; image coordinates have their origin at the corner of the first pixel,
// not at its center.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "incognita/analysis/evaluation/trajectory.hpp"
#include "incognita/record/snapshot/snapshot.hpp"

namespace incognita {

/// foxglove.FrameTransform: pose of the child frame in the parent frame.
std::string frame_transform(std::uint64_t time_ns, std::string_view parent, std::string_view child,
                            const StampedPose& child_in_parent);

/// foxglove.PoseInFrame.
std::string pose_in_frame(std::uint64_t time_ns, std::string_view frame, const StampedPose& pose);

/// foxglove.SceneUpdate: each landmark as the 2-sigma ellipsoid of its covariance, anchors as small spheres
/// of another color. Each message replaces the previous one.
std::string scene_update(std::uint64_t time_ns, std::string_view frame,
                         const std::vector<SnapshotLandmark>& landmarks);

/// foxglove.CompressedImage, as JPEG.
std::string compressed_image(std::uint64_t time_ns, std::string_view frame, const Image& image);

/// foxglove.ImageAnnotations: the 3-sigma search ellipse of each searched feature in the color of its
/// outcome, and a square at each matched patch.
std::string image_annotations(std::uint64_t time_ns, const std::vector<SnapshotMatch>& matches,
                              int patch_size_px);

}  // namespace incognita
