#include "incognita/slam/features/patch_plane.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>

namespace incognita {
namespace {

constexpr int max_pixels = (max_patch_size - 2) * (max_patch_size - 2);
constexpr double sigma_gray = 2;  // of the image and of the stored patch, each
// Interpolation, lighting and curvature errors are correlated between neighboring pixels and between views.
// Without these two terms the estimated slopes were overconfident by a factor of ten against the ground truth
// of the rendered room.
constexpr double residual_share = 0.1;  // lower bound, relative to the patch's contrast
constexpr double correlated_pixels = 100;
constexpr double max_step = 0.3;   // of a slope per update: beyond, the warp is not linear in it
constexpr double max_slope = 2.5;  // 68 degrees: flatter planes are not tracked

// The inner pixels of a patch, since those at its border have no gradient
using Pixels = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, max_pixels, 1>;
using Slopes = Eigen::Matrix<double, Eigen::Dynamic, 2, 0, max_pixels, 2>;

template <typename Gray>
Pixels inner_pixels(int size, const Gray& gray) {
  Pixels pixels((size - 2) * (size - 2));
  Eigen::Index i = 0;
  for (int r = 1; r < size - 1; ++r)
    for (int c = 1; c < size - 1; ++c) pixels[i++] = gray(r, c);
  return pixels;
}

/// Gray levels of a template, up to a constant.
auto gray_of(const PatchTemplate& patch) {
  return [&patch](int r, int c) { return patch.values[r * PatchTemplate::row_stride + c] / 8.0; };
}

/// Subtracts the mean and scales to unit norm, as normalized correlation does. Returns the norm.
double normalize(Pixels& pixels) {
  pixels.array() -= pixels.mean();
  const double length = pixels.norm();
  if (length > 0) pixels /= length;
  return length;
}

Slopes gradient(const PatchTemplate& patch) {
  const auto gray = gray_of(patch);
  Slopes slopes((patch.size - 2) * (patch.size - 2), 2);
  slopes.col(0) =
      inner_pixels(patch.size, [&](int r, int c) { return (gray(r, c + 1) - gray(r, c - 1)) / 2; });
  slopes.col(1) =
      inner_pixels(patch.size, [&](int r, int c) { return (gray(r + 1, c) - gray(r - 1, c)) / 2; });
  return slopes;
}

}  // namespace

namespace {

/// The directions in which the slopes are counted, world: 3 x 2.
Eigen::Matrix<double, 3, 2> slope_axes(const Eigen::Vector3d& facing) {
  Eigen::Matrix<double, 3, 2> axes;
  axes.col(0) = facing.unitOrthogonal();
  axes.col(1) = facing.cross(axes.col(0));
  return axes;
}

}  // namespace

Eigen::Vector3d PatchPlane::normal(const Eigen::Vector2d& any_slope) const {
  return (facing + slope_axes(facing) * any_slope).normalized();
}

void turn(PatchPlane& plane, const Eigen::Matrix3d& R) {
  const Eigen::Vector3d facing = R * plane.facing;
  const Eigen::Matrix2d to_new_axes = slope_axes(facing).transpose() * R * slope_axes(plane.facing);
  plane.facing = facing;
  plane.slope = to_new_axes * plane.slope;
  plane.slope_cov = to_new_axes * plane.slope_cov * to_new_axes.transpose();
}

std::optional<PlaneEvidence> plane_evidence(const Image& image, const Eigen::Vector2d& found,
                                            const PatchTemplate& expected,
                                            const std::array<PatchTemplate, 2>& tilted, double slope_step) {
  const int size = expected.size, half = size / 2;
  Pixels patch = inner_pixels(size, gray_of(expected));
  Pixels observed_patch = inner_pixels(
      size, [&](int r, int c) { return image.sample(found.x() + c - half, found.y() + r - half); });
  const double patch_length = normalize(patch), seen_length = normalize(observed_patch);
  if (!(patch_length > 0 && seen_length > 0)) return std::nullopt;
  Slopes by_shift = gradient(expected) / patch_length;
  for (int k = 0; k < 2; ++k) {  // remove what correlation is invariant to: offset and contrast
    by_shift.col(k).array() -= by_shift.col(k).mean();
    by_shift.col(k) -= patch * patch.dot(by_shift.col(k));
  }
  Slopes by_slope(patch.size(), 2);
  for (int k = 0; k < 2; ++k) {
    Pixels moved = inner_pixels(size, gray_of(tilted[k]));
    if (!(normalize(moved) > 0)) return std::nullopt;
    by_slope.col(k) = (moved - patch * patch.dot(moved)) / slope_step;
  }
  const Eigen::Matrix2d structure = by_shift.transpose() * by_shift;
  if (!(structure.determinant() > 1e-12)) return std::nullopt;
  PlaneEvidence evidence;
  evidence.shift_per_slope = -structure.inverse() * (by_shift.transpose() * by_slope);
  // Least squares for shift and slope, with the shift eliminated
  const Slopes free_of_shift = by_slope + by_shift * evidence.shift_per_slope;
  const Pixels residual = observed_patch - patch;
  const double noise_var =
      sigma_gray * sigma_gray * (1 / (seen_length * seen_length) + 1 / (patch_length * patch_length));
  const double pixels = static_cast<double>(residual.size());
  const double var = correlated_pixels * (std::max(noise_var, residual.squaredNorm() / (pixels - 4)) +
                                          residual_share * residual_share / pixels);
  evidence.information = free_of_shift.transpose() * free_of_shift / var;
  evidence.gradient = free_of_shift.transpose() * residual / var;
  return evidence;
}

void update_patch_plane(PatchPlane& plane, const PlaneEvidence& evidence) {
  const Eigen::Matrix2d cov = (plane.slope_cov.inverse() + evidence.information).inverse();
  const Eigen::Vector2d step = cov * evidence.gradient;
  const Eigen::Vector2d whole = plane.slope + step;
  plane.slope += step.cwiseMax(-max_step).cwiseMin(max_step);
  plane.slope = plane.slope.cwiseMax(-max_slope).cwiseMin(max_slope);
  // After a truncated step the covariance is kept, to stay conservative
  if (plane.slope == whole) plane.slope_cov = (cov + cov.transpose()) / 2;
}

}  // namespace incognita
