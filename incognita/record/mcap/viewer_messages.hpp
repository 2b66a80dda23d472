// What the viewers of the field know how to show, as JSON: messages named after Foxglove's schemas, laid out
// as message_schemas.hpp says. Orientations are world_from_camera, as everywhere; images have their origin at
// the corner of the first pixel, not at its centre.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "incognita/analysis/evaluation/trajectory.hpp"
#include "incognita/record/snapshot/snapshot.hpp"

namespace incognita {

/// foxglove.FrameTransform: where the child frame is in the parent.
std::string frame_transform(std::uint64_t time_ns, std::string_view parent, std::string_view child,
                            const StampedPose& child_in_parent);

/// foxglove.PoseInFrame.
std::string pose_in_frame(std::uint64_t time_ns, std::string_view frame, const StampedPose& pose);

/// foxglove.SceneUpdate: each landmark as the ellipsoid that its covariance makes at 2 sigma, anchors as
/// small balls of another colour. It replaces the one before.
std::string scene_update(std::uint64_t time_ns, std::string_view frame,
                         const std::vector<SnapshotLandmark>& landmarks);

/// foxglove.CompressedImage, as JPEG.
std::string compressed_image(std::uint64_t time_ns, std::string_view frame, const Image& image);

/// foxglove.ImageAnnotations: the 3-sigma ellipse of each look that was searched for, in the colour of its
/// outcome, and a square where its patch was found.
std::string image_annotations(std::uint64_t time_ns, const std::vector<SnapshotMatch>& matches,
                              int patch_size_px);

}  // namespace incognita
