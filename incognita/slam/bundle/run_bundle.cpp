#include "incognita/slam/bundle/run_bundle.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <limits>
#include <optional>

#include "incognita/math/median.hpp"
#include "incognita/math/quaternion.hpp"
#include "incognita/slam/bundle/bundle_equations.hpp"

namespace incognita {
namespace {

constexpr double prior_sigmas = 2;  // of inverse depths, in times their start
using Pixels = std::vector<std::pair<int, Eigen::Vector2d>>;

const BundleView& view_at(const RunMatches& run, int view) {
  return run.views[static_cast<std::size_t>(view)];
}

/// The point nearest to all rays, if they are not parallel.
std::optional<Eigen::Vector3d> intersection(const RunMatches& run, const Pixels& pixels,
                                            const Camera& camera) {
  constexpr double least_parallax = 1e-4;  // smallest eigenvalue, per ray
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  for (const auto& [k, pixel] : pixels) {
    const auto ray = camera.unproject(pixel);
    if (!ray) continue;
    const BundleView& view = view_at(run, k);
    const Eigen::Vector3d along = rotation_matrix<double>(view.world_from_camera) * ray->normalized();
    const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - along * along.transpose();
    A += across;
    b += across * view.position;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(A);
  if (eigen.eigenvalues()[0] < least_parallax * static_cast<double>(pixels.size())) return std::nullopt;
  return eigen.eigenvectors() * eigen.eigenvalues().cwiseInverse().asDiagonal() *
         eigen.eigenvectors().transpose() * b;
}

/// Of the intersection of its rays in its first view, 1/m.
std::optional<double> inverse_depth(const RunMatches& run, const Pixels& pixels, const Camera& camera) {
  const auto at = intersection(run, pixels, camera);
  if (!at) return std::nullopt;
  const BundleView& host = view_at(run, pixels.front().first);
  const double depth_m =
      (rotation_matrix<double>(host.world_from_camera).transpose() * (*at - host.position)).z();
  return depth_m > 0 ? std::optional(1 / depth_m) : std::nullopt;
}

BundlePoint point_in(const BundleView& view, int host, const Eigen::Vector3d& ray, double inverse_depth) {
  BundlePoint point;
  point.kind = BundlePoint::Kind::inverse_depth;
  point.initial_axes = view.world_from_camera;
  point.host = host;
  point.value << ray.x() / ray.z(), ray.y() / ray.z(), inverse_depth;
  point.prior_inverse_depth = inverse_depth;
  point.sigma_prior_inverse_depth = prior_sigmas * inverse_depth;
  return point;
}

BundlePoint known_point(const Eigen::Vector3d& at) {
  BundlePoint point;
  point.kind = BundlePoint::Kind::fixed;
  point.value = at;
  return point;
}

}  // namespace

Bundle bundle_of(const RunMatches& run, const Camera& camera, double sigma_pixel_px) {
  Bundle bundle;
  bundle.views = run.views;
  bundle.first_view = run.views.front();
  const bool has_anchors =
      std::ranges::any_of(run.pixels, [&](const auto& track) { return run.known.contains(track.first); });
  const double var = has_anchors ? 1 : 1e-6;  // m^2, rad^2: anchors give the frame
  bundle.first_view_cov = var * Eigen::Matrix<double, 6, 6>::Identity();
  std::map<std::int64_t, std::optional<double>> inverse_depths;
  std::vector<double> all;
  for (const auto& [id, pixels] : run.pixels) {
    if (pixels.size() < least_matches_of_landmark || run.known.contains(id)) continue;
    const auto found = inverse_depths[id] = inverse_depth(run, pixels, camera);
    if (found) all.push_back(*found);
  }
  const double typical = all.empty() ? 1 : median(all);
  const Eigen::Matrix2d cov = sigma_pixel_px * sigma_pixel_px * Eigen::Matrix2d::Identity();
  for (const auto& [id, pixels] : run.pixels) {
    const auto known = run.known.find(id);
    if (known == run.known.end() && pixels.size() < least_matches_of_landmark) continue;
    const int host = pixels.front().first;
    const auto ray = camera.unproject(pixels.front().second);
    if (known == run.known.end() && !(ray && ray->z() > 0)) continue;
    for (const auto& [view, pixel] : pixels)
      bundle.observations.push_back({view, static_cast<int>(bundle.points.size()), pixel, cov});
    bundle.points.push_back(known != run.known.end() ? known_point(known->second)
                                                     : point_in(view_at(run, host), host, *ray,
                                                                inverse_depths.at(id).value_or(typical)));
  }
  return bundle;
}

std::vector<double> residuals_px(const Bundle& bundle, const Camera& camera) {
  std::vector<double> out;
  for (const BundleObservation& seen : bundle.observations) {
    const auto predicted = predicted_pixel(bundle, seen, camera);
    out.push_back(predicted ? (seen.pixel - *predicted).norm() : std::numeric_limits<double>::infinity());
  }
  return out;
}

}  // namespace incognita
