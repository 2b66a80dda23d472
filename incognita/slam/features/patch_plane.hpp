// The plane a patch lies in: unknown when a landmark is born, learnt from how the patch looks from elsewhere
// (after N. Molton, A. Davison, I. Reid, "Locally planar patch features for real-time structure from motion",
// BMVC 2004). A patch warped as if it lay in another plane is found beside its true place, by the same amount
// for as long as the view is the same: an error that no filter can average away.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

#include "incognita/vision/image.hpp"
#include "incognita/vision/patch.hpp"

namespace incognita {

struct PatchPlane {
  Eigen::Vector3d facing{0, 0,
                         1};    ///< unit, world: towards the camera at birth, or the normal if it is known
  Eigen::Vector2d slope{0, 0};  ///< tangents of the tilt away from `facing`
  Eigen::Matrix2d slope_cov = Eigen::Matrix2d::Zero();  ///< zero: the plane is known
  Eigen::Vector3d estimated_from{0, 0,
                                 0};  ///< camera position of the last view that taught anything, world, m

  bool known() const { return slope_cov.isZero(0); }
  Eigen::Vector3d normal() const { return normal(slope); }
  Eigen::Vector3d normal(const Eigen::Vector2d& any_slope) const;  ///< unit, world
};

/// What one match says of the plane.
struct PlaneEvidence {
  Eigen::Matrix2d shift_per_slope;  ///< px: how far off the patch is found when the slope is one too small
  Eigen::Matrix2d information;      ///< of the slope, the patch's place being unknown as well
  Eigen::Vector2d gradient;         ///< information * (slope that fits best - slope assumed)
};

/// `expected` is the patch as warped now, `tilted` as warped with either slope larger by `slope_step`; the
/// image around `found` (px) is compared with them. All of the patch but its rim is used. Nothing when the
/// patch does not fix a place by itself.
std::optional<PlaneEvidence> plane_evidence(const Image& image, const Eigen::Vector2d& found,
                                            const PatchTemplate& expected,
                                            const std::array<PatchTemplate, 2>& tilted, double slope_step);

/// Takes evidence into the slope and its covariance.
void update_patch_plane(PatchPlane& plane, const PlaneEvidence& evidence);

}  // namespace incognita
