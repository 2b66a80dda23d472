// The plane of a patch: unknown at initialization, estimated from the appearance of the patch in other views
// (after N. Molton, A. Davison, I. Reid, "Locally planar patch features for real-time structure from motion",
// BMVC 2004). A patch warped with the wrong plane is matched beside its true position, by a systematic error
// as long as the view is the same, which no filter averages out.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

#include "incognita/vision/image.hpp"
#include "incognita/vision/patch.hpp"

namespace incognita {

struct PatchPlane {
  Eigen::Vector3d facing{0, 0, 1};  ///< unit, world: towards the initial camera, or the known normal
  Eigen::Vector2d slope{0, 0};      ///< tangents of the tilt from `facing`
  Eigen::Matrix2d slope_cov = Eigen::Matrix2d::Zero();  ///< zero: the plane is known
  Eigen::Vector3d estimated_from{0, 0, 0};  ///< camera position of the last informative view, world, m

  bool known() const { return slope_cov.isZero(0); }
  Eigen::Vector3d normal() const { return normal(slope); }
  Eigen::Vector3d normal(const Eigen::Vector2d& any_slope) const;  ///< unit, world
};

/// Turns a plane in the world.
void turn(PatchPlane& plane, const Eigen::Matrix3d& R);

/// Information of one match about the plane.
struct PlaneEvidence {
  Eigen::Matrix2d shift_per_slope;  ///< px: shift of the match per error of the slope
  Eigen::Matrix2d information;      ///< of the slope, with the position of the patch marginalized out
  Eigen::Vector2d gradient;         ///< information * (best slope - assumed slope)
};

/// `expected` is the patch as currently warped, `tilted` as warped with either slope increased by
/// `slope_step`; both are compared with the image around `found` (px), excluding the border of the patch.
/// Nothing when the texture does not determine a position.
std::optional<PlaneEvidence> plane_evidence(const Image& image, const Eigen::Vector2d& found,
                                            const PatchTemplate& expected,
                                            const std::array<PatchTemplate, 2>& tilted, double slope_step);

/// Updates the slope and its covariance with the information of a match.
void update_patch_plane(PatchPlane& plane, const PlaneEvidence& evidence);

}  // namespace incognita
