#include "incognita/slam/bundle/two_view_start.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>

#include "incognita/math/median.hpp"
#include "incognita/slam/bundle/adjust_bundle.hpp"
#include "incognita/slam/bundle/flat_start.hpp"
#include "incognita/slam/bundle/relative_pose.hpp"

namespace incognita {
namespace {

constexpr double tolerance_px = 1.5;
constexpr int least_points = 8;                                         // that determine a view between
constexpr double least_inlier_share = 0.6;                              // of the points in both views
constexpr double least_share_of_median = 0.05, most_times_median = 20;  // inverse depths of points

struct SharedPoints {
  std::vector<int> points;
  std::vector<Eigen::Vector3d> first, last;  ///< rays (x, y, 1)
  std::vector<double>
      pixel_sizes;  ///< of the last: how far a ray moves by a pixel, which depends on the lens
  std::vector<double> inverse_depths;  ///< in the first view, 1/m
  std::vector<bool> is_known;  ///< neither an outlier nor too near or far for its inverse depth to be right
};

/// Points whose host is the first view and that the last view sees, too.
SharedPoints shared_points(const Bundle& bundle, const Camera& camera) {
  SharedPoints shared;
  const int last = static_cast<int>(bundle.views.size()) - 1;
  std::map<int, Eigen::Vector3d> in_first;
  for (const BundleObservation& seen : bundle.observations) {
    const BundlePoint& point = bundle.points[static_cast<std::size_t>(seen.point)];
    if (point.kind != BundlePoint::Kind::inverse_depth || point.host != 0) continue;
    const auto ray = camera.unproject(seen.pixel),
               beside = camera.unproject(seen.pixel + Eigen::Vector2d(1, 0));
    if (!ray || !beside) continue;
    if (seen.view == 0) in_first[seen.point] = *ray;
    if (seen.view != last || !in_first.contains(seen.point)) continue;
    shared.points.push_back(seen.point);
    shared.first.push_back(in_first[seen.point]);
    shared.last.push_back(*ray);
    shared.pixel_sizes.push_back((*beside - *ray).norm());
  }
  return shared;
}

/// Inverse depth, in the first view, of the point of the first ray nearest to the second; 0 for parallel rays.
double inverse_depth(const RelativePose& pose, const Eigen::Vector3d& first, const Eigen::Vector3d& second) {
  const Eigen::Vector3d to = rotation_matrix<double>(pose.first_from_second) * second;
  // first / rho - direction is parallel to `to`: first x to = rho direction x to
  const Eigen::Vector3d parallax = first.cross(to), base = pose.direction.cross(to);
  return base.dot(parallax) / std::max(base.squaredNorm(), 1e-12);
}

void place_views(std::vector<BundleView>& views, const RelativePose& pose, double baseline) {
  const BundleView first = views.front();
  const Eigen::Matrix3d world_from_first = rotation_matrix<double>(first.world_from_camera);
  const Eigen::Vector3d turn = quaternion_log(pose.first_from_second);
  for (std::size_t i = 1; i < views.size(); ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(views.size() - 1);
    views[i].position = first.position + share * baseline * world_from_first * pose.direction;
    views[i].world_from_camera =
        quaternion_product(first.world_from_camera, quaternion_exp<double>(share * turn));
  }
}

/// The bundle of one view and the shared points as known positions. Nothing if too few are seen from there.
std::optional<Bundle> resection(const Bundle& bundle, const SharedPoints& shared, int view) {
  const BundleView& first = bundle.views.front();
  const Eigen::Matrix3d world_from_first = rotation_matrix<double>(first.world_from_camera);
  Bundle one;
  one.views = {first, bundle.views[static_cast<std::size_t>(view)]};
  one.views[0].fixed = true;
  for (const BundleObservation& seen : bundle.observations) {
    if (seen.view != view) continue;
    const auto point = std::ranges::find(shared.points, seen.point);
    const auto i = static_cast<std::size_t>(std::distance(shared.points.begin(), point));
    if (point == shared.points.end() || !shared.is_known[i]) continue;
    one.observations.push_back({1, static_cast<int>(one.points.size()), seen.pixel, seen.cov});
    one.points.push_back(
        {.kind = BundlePoint::Kind::fixed,
         .value = first.position + world_from_first * shared.first[i] / shared.inverse_depths[i]});
  }
  if (one.points.size() < least_points) return std::nullopt;
  return one;
}

/// Views between the first and the last where they see the shared points from: the camera need not have moved along a line.
void fit_middle_views(Bundle& bundle, const Camera& camera, const SharedPoints& shared,
                      const AdjustmentSettings& settings) {
  BundleEquations equations;
  for (int view = 1; view + 1 < static_cast<int>(bundle.views.size()); ++view) {
    std::optional<Bundle> one = resection(bundle, shared, view);
    if (!one) continue;
    adjust(*one, camera, settings, equations);
    one->views[1].fixed = bundle.views[static_cast<std::size_t>(view)].fixed;
    bundle.views[static_cast<std::size_t>(view)] = one->views[1];
  }
}

}  // namespace

std::optional<Bundle> two_view_start(Bundle bundle, const Camera& camera,
                                     const AdjustmentSettings& settings) {
  if (std::ranges::any_of(bundle.points, [](const BundlePoint& point) {
        return point.kind != BundlePoint::Kind::inverse_depth;
      }))
    return std::nullopt;
  SharedPoints shared = shared_points(bundle, camera);
  if (shared.pixel_sizes.empty()) return std::nullopt;
  const auto pose = relative_pose(shared.first, shared.last, tolerance_px * median(shared.pixel_sizes));
  if (!pose || static_cast<double>(std::ranges::count(pose->is_inlier, true)) <
                   least_inlier_share * static_cast<double>(shared.points.size()))
    return std::nullopt;
  std::vector<double> per_baseline, priors;
  for (std::size_t i = 0; i < shared.points.size(); ++i) {
    per_baseline.push_back(inverse_depth(*pose, shared.first[i], shared.last[i]));
    priors.push_back(bundle.points[static_cast<std::size_t>(shared.points[i])].prior_inverse_depth);
  }
  std::vector<double> sorted = per_baseline;
  const double middle = median(sorted), wanted = median(priors);
  if (!(middle > 0 && wanted > 0)) return std::nullopt;
  for (std::size_t i = 0; i < shared.points.size(); ++i) {
    const double ratio = per_baseline[i] / middle;
    shared.inverse_depths.push_back(wanted * std::clamp(ratio, least_share_of_median, most_times_median));
    shared.is_known.push_back(pose->is_inlier[i] && ratio > least_share_of_median &&
                              ratio < most_times_median);
  }
  place_views(bundle.views, *pose, middle / wanted);
  fit_middle_views(bundle, camera, shared, settings);
  put_on_rays(bundle, camera, wanted);
  for (std::size_t i = 0; i < shared.points.size(); ++i)
    bundle.points[static_cast<std::size_t>(shared.points[i])].value[2] = shared.inverse_depths[i];
  return bundle;
}

}  // namespace incognita
