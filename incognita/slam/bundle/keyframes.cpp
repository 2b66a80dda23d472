#include "incognita/slam/bundle/keyframes.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "incognita/math/median.hpp"
#include "incognita/slam/bundle/flat_start.hpp"
#include "incognita/slam/bundle/point_in_view.hpp"
#include "incognita/slam/bundle/two_view_start.hpp"

namespace incognita {
namespace {

/// Matches of a landmark in fixed keyframes that are kept: its first, and the last of them.
constexpr int max_fixed_matches = 20;

/// Keyframes after which the start is settled, and those of them that are near together: a turn alone may use these up.
constexpr int max_start_views = 15, max_near_views = 10;
/// Of the cost, below which another start is taken, if both are at their minima: these take more iterations.
constexpr double better_share = 0.9;
constexpr int times_iterations = 4;

/// Of a keyframe: fewer may not determine its pose, and the filter knows its motion.
constexpr int least_matches = 8;

constexpr double least_inverse_depth = 1e-6;

/// Of a prior of the first view, m^2 and rad^2: with less it is fixed.
constexpr double least_prior_var = 1e-7;

/// The vector from `from` to a point in inverse depth, times its inverse depth, world axes: finite at infinity.
Eigen::Vector3d scaled_vector(const BundlePoint& point, const Eigen::Vector3d& host,
                              const Eigen::Vector3d& from) {
  const Eigen::Vector3d ray =
      rotation_matrix<double>(point.initial_axes) * Eigen::Vector3d(point.value[0], point.value[1], 1);
  return ray + point.value[2] * (host - from);
}

/// The change of a view: of its position, and the rotation vector in the axes of the view before.
using ViewShift = Eigen::Matrix<double, 6, 1>;
ViewShift shift_of(const BundleView& from, const BundleView& to) {
  ViewShift shift;
  shift << to.position - from.position,
      quaternion_log(quaternion_product(quaternion_conjugate(from.world_from_camera), to.world_from_camera));
  return shift;
}

/// Moves the pose, and velocity and rate by its change relative to the keyframe before, `elapsed_s` earlier: the filter had
/// them from its own poses.
void move_camera(AnyBelief& belief, BlockId body, const BundleView& to, const ViewShift& relative,
                 double elapsed_s) {
  CameraState camera = belief.mean(body);
  camera.head<3>() = to.position;
  camera.segment<4>(3) = to.world_from_camera;
  if (elapsed_s > 0) camera.tail<6>() += relative / elapsed_s;
  belief.set_mean(body, camera);
}

/// Moves the landmarks that were not adjusted to their means given that the pose errors are `shift`, P_lc P_cc^-1 shift: as the filter
/// moved them with the camera before.
void move_others(Estimate& estimate, BlockId body, const ViewShift& shift,
                 const std::vector<std::int64_t>& adjusted) {
  AnyBelief& belief = estimate.belief;
  const Eigen::LLT<Eigen::Matrix<double, 6, 6>> pose_cov(belief.covariance(body).topLeftCorner<6, 6>());
  if (pose_cov.info() != Eigen::Success) return;
  const ViewShift weighted = pose_cov.solve(shift);
  for (const auto& [id, landmark] : estimate.landmarks) {
    if (!landmark.mapped() || std::ranges::binary_search(adjusted, id)) continue;
    const SmallVector y = belief.mean(landmark.block);
    belief.set_mean(landmark.block, y + belief.covariance(landmark.block, body).leftCols<6>() * weighted);
  }
}

/// Moves a landmark to the point, if its parametrization can hold that. The initial position stays.
void move_landmark(AnyBelief& belief, const Landmark& landmark, const BundlePoint& point,
                   const Eigen::Vector3d& host) {
  if (landmark.form.kind == LandmarkParametrization::Kind::point) {
    if (point.value[2] <= least_inverse_depth) return;
    belief.set_mean(landmark.block, host + scaled_vector(point, host, host) / point.value[2]);
    return;
  }
  InverseDepthLandmark::State y = belief.mean(landmark.block);
  const Eigen::Vector3d along = rotation_matrix<double>(landmark.form.initial_axes).transpose() *
                                scaled_vector(point, host, y.head<3>());
  if (!(along.z() > 0.1 * along.norm())) return;
  y.tail<3>() << along.x() / along.z(), along.y() / along.z(), point.value[2] / along.z();
  belief.set_mean(landmark.block, y);
}

}  // namespace

void Keyframes::start(const CameraState& camera, const Eigen::Matrix<double, 6, 6>& cov, double t) {
  views_.clear();
  views_[0] = view_of(camera);
  views_[0].fixed = cov.diagonal().maxCoeff() < least_prior_var;
  begins_ = views_[0].fixed;
  cost_ = 0;
  first_view_ = views_[0];
  first_view_cov_ = cov;
  tracks_.clear();
  ids_.clear();
  frames_ = 0;
  times_ = {{0, t}};
  t_ = t_before_ = t;
}

bool Keyframes::is_due(const std::vector<KeyframeMatch>& matches, const KeyframePolicy& policy) {
  if (++frames_ < policy.min_frames || static_cast<int>(matches.size()) < least_matches) return false;
  int in_last = 0;
  for (const auto& [id, track] : tracks_) in_last += track.seen.back().view == last();
  double squares = 0;
  int moved = 0;
  for (const KeyframeMatch& match : matches) {
    const auto known = tracks_.find(match.id);
    if (known == tracks_.end() || known->second.seen.back().view != last()) continue;
    squares += (match.pixel - known->second.seen.back().pixel).squaredNorm();
    ++moved;
  }
  const bool is_near = is_starting() && last() < max_near_views;
  const double motion_px =
      is_near ? std::min(policy.min_start_motion_px, policy.min_motion_px) : policy.min_motion_px;
  return moved == 0 || static_cast<double>(matches.size()) < policy.min_matched_share * in_last ||
         squares > moved * motion_px * motion_px;
}

void Keyframes::add(const Estimate& estimate, BlockId body, const std::vector<KeyframeMatch>& matches,
                    double t) {
  t_before_ = std::exchange(t_, t);
  views_[last() + 1] = view_of(estimate.belief.mean(body));
  times_[last()] = t;
  add_matches(estimate, body, matches);
  frames_ = 0;
}

void Keyframes::add_matches(const Estimate& estimate, BlockId body,
                            const std::vector<KeyframeMatch>& matches) {
  for (const KeyframeMatch& match : matches) {
    Track& track = tracks_[match.id];
    const Landmark& landmark = estimate.landmarks.at(match.id);
    if (track.seen.empty() && !landmark.fixed && !is_starting())
      if (const auto point = point_in_view(landmark, estimate.belief, last_view()))
        track.prior = DepthPrior{point->z(), sigma_inverse_depth_in_view(landmark, estimate.belief, body)};
    track.is_reference |= match.is_reference;
    track.seen.push_back({last(), match.pixel, match.cov});
  }
}

void Keyframes::add_new(const KeyframeMatch& match, const DepthPrior& prior) {
  Track& track = tracks_[match.id];
  track.prior = prior;
  track.seen.push_back({last(), match.pixel, match.cov});
}

/// The landmark as seen from its first keyframe; nothing behind it.
std::optional<BundlePoint> Keyframes::point_of(const Track& track, const Landmark& landmark,
                                               const Estimate& estimate, const DepthPrior& prior) const {
  BundlePoint point;
  if (landmark.fixed) {
    point.kind = BundlePoint::Kind::fixed;
    point.value = landmark.position;
    return point;
  }
  if (track.is_reference) {
    const auto known = position_of(landmark, estimate);
    if (!known) return std::nullopt;
    point.kind = BundlePoint::Kind::fixed;
    point.value = known->position;
    return point;
  }
  point.kind = BundlePoint::Kind::inverse_depth;
  point.host = track.seen.front().view;
  const BundleView& host = views_.at(point.host);
  const auto value = point_in_view(landmark, estimate.belief, host);
  if (!value) return std::nullopt;
  point.value = *value;
  point.initial_axes = host.world_from_camera;
  point.prior_inverse_depth = track.prior.value_or(prior).mean;
  point.sigma_prior_inverse_depth = track.prior.value_or(prior).sigma;
  return point;
}

/// Forgets landmarks that were deleted and not seen since, old matches of the others, and views without any.
void Keyframes::forget_before(int first_free) {
  std::map<int, BundleView> kept(views_.lower_bound(first_free), views_.end());
  for (auto& [id, track] : tracks_) {
    const auto first_in_window =
        std::ranges::find_if(track.seen, [&](const Seen& seen) { return seen.view >= first_free; });
    const auto old = std::distance(track.seen.begin(), first_in_window);
    if (old > 1 + max_fixed_matches)
      track.seen.erase(track.seen.begin() + 1, first_in_window - max_fixed_matches);
    for (const Seen& seen : track.seen)
      if (seen.view < first_free) kept.insert({seen.view, views_.at(seen.view)});
  }
  views_ = std::move(kept);
  times_.erase(times_.begin(), times_.lower_bound(first_free));
}

/// The views of the points of the bundle; those before `first_free` are fixed.
void Keyframes::add_views(int first_free) {
  numbers_.clear();
  indices_.clear();
  bundle_.views.clear();
  for (const auto& [number, view] : views_) {
    indices_[number] = static_cast<int>(numbers_.size());
    numbers_.push_back(number);
    bundle_.views.push_back(view);
    bundle_.views.back().fixed = view.fixed || number < first_free;
  }
  // The prior is of view 0 only
  if (numbers_.front() > 0) bundle_.views.front().fixed = true;
  bundle_.first_view = first_view_;
  bundle_.first_view_cov = first_view_cov_;
}

/// The landmarks seen in the window, with their matches.
void Keyframes::add_points(const Estimate& estimate, const DepthPrior& prior, int first_free) {
  ids_.clear();
  bundle_.points.clear();
  bundle_.observations.clear();
  for (auto& [id, track] : tracks_) {
    if (track.seen.back().view < first_free || track.seen.size() < 2) continue;
    const auto landmark = estimate.landmarks.find(id);
    const bool is_new = !track.point || track.is_reference;
    if (is_new && landmark != estimate.landmarks.end())
      track.point = point_of(track, landmark->second, estimate, prior);
    if (!track.point) continue;
    const int index = static_cast<int>(ids_.size());
    for (const Seen& seen : track.seen)
      bundle_.observations.push_back({indices_.at(seen.view), index, seen.pixel, seen.cov});
    bundle_.points.push_back(*track.point);
    if (track.point->host >= 0) bundle_.points.back().host = indices_.at(track.point->host);
    ids_.push_back(id);
  }
}

void Keyframes::take_bundle() {
  for (std::size_t i = 0; i < numbers_.size(); ++i) {
    BundleView& view = views_.at(numbers_[i]);
    view.position = bundle_.views[i].position;
    view.world_from_camera = bundle_.views[i].world_from_camera;
  }
  for (std::size_t i = 0; i < ids_.size(); ++i) {
    BundlePoint& point = *tracks_.at(ids_[i]).point;
    point.value = bundle_.points[i].value;
    point.initial_axes = bundle_.points[i].initial_axes;
  }
}

void Keyframes::move_means(Estimate& estimate, BlockId body, const BundleView& before) const {
  const BundleView last = view_of(estimate.belief.mean(body));
  const ViewShift now = shift_of(last, last_view()), earlier = shift_of(before, view_before());
  const Eigen::Matrix3d last_from_before =
      rotation_matrix<double>(last_view().world_from_camera).transpose() *
      rotation_matrix<double>(view_before().world_from_camera);
  ViewShift relative = now - earlier;
  relative.tail<3>() = now.tail<3>() - last_from_before * earlier.tail<3>();  // the rate is in camera axes
  move_camera(estimate.belief, body, last_view(), relative, elapsed_s());
  // Fitted to references, the camera moved in the map, and the map stays
  const bool fits_to_references =
      std::ranges::any_of(ids_, [&](std::int64_t id) { return tracks_.at(id).is_reference; });
  if (!fits_to_references) move_others(estimate, body, now, ids_);
  for (const std::int64_t id : ids_) {
    const auto landmark = estimate.landmarks.find(id);
    const BundlePoint& point = *tracks_.at(id).point;
    if (landmark == estimate.landmarks.end() || point.kind == BundlePoint::Kind::fixed) continue;
    move_landmark(estimate.belief, landmark->second, point, views_.at(point.host).position);
  }
}

AdjustmentReport Keyframes::adjust(Estimate& estimate, BlockId body, const Camera& camera,
                                   const AdjustmentSettings& settings, const DepthPrior& prior, int window) {
  const int first_free = std::max(0, last() + 1 - window);
  std::erase_if(tracks_, [&](const auto& item) {
    return item.second.seen.back().view < first_free && !estimate.landmarks.contains(item.first);
  });
  forget_before(first_free);
  add_views(first_free);
  add_points(estimate, prior, first_free);
  const AdjustmentReport report = incognita::adjust(bundle_, camera, settings, equations_);
  const bool is_refused = report.outcome == AdjustmentReport::Outcome::refused;
  cost_ = is_refused ? report.first_cost : report.last_cost;
  window_ = window;
  if (is_refused) return report;
  const BundleView before = view_before();
  take_bundle();
  move_means(estimate, body, before);
  return report;
}

std::vector<PastPose> Keyframes::window() const {
  std::vector<PastPose> poses;
  for (const auto& [number, t] : times_) {
    const BundleView& view = views_.at(number);
    poses.push_back({t, {view.position, view.world_from_camera}});
  }
  return poses;
}

bool Keyframes::is_starting() const {
  return begins_ && last() < std::min(max_start_views, window_) && views_.begin()->first == 0;
}

bool Keyframes::start_again(const Camera& camera, const AdjustmentSettings& settings) {
  if (!is_starting()) return false;
  // Each trial takes longer than the one before
  if (last() > max_near_views && last() + 1 < std::min(max_start_views, window_)) return false;
  // Two views fit nearly any depths, and noise alone costs half of the rows
  if (view_count() < 3 && cost_ < static_cast<double>(bundle_.observations.size())) return false;
  if (std::ranges::any_of(bundle_.points, [](const BundlePoint& point) {
        return point.kind != BundlePoint::Kind::inverse_depth;
      }))
    return false;  // known points give the start
  AdjustmentSettings thorough = settings;
  thorough.max_iterations *= times_iterations;
  Bundle best;
  double least = std::numeric_limits<double>::infinity();
  const auto try_from = [&](Bundle other) {
    const AdjustmentReport report = incognita::adjust(other, camera, thorough, equations_);
    if (report.outcome != AdjustmentReport::Outcome::refused && report.last_cost < least) {
      least = report.last_cost;
      best = other;
    }
    return other;
  };
  const Bundle flat = try_from(flat_start(bundle_, camera));
  try_from(reversed_start(flat, camera));
  if (auto two_views = two_view_start(bundle_, camera, settings)) try_from(*std::move(two_views));
  if (!(least < better_share * cost_)) return false;
  Bundle same = bundle_;
  if (!(least < better_share * incognita::adjust(same, camera, thorough, equations_).last_cost)) return false;
  bundle_ = std::move(best);
  cost_ = least;
  take_bundle();
  return true;
}

double Keyframes::moved_px(const Estimate& estimate, const CameraState& from, const Camera& camera) const {
  const BundleView view = view_of(from);
  const Eigen::Matrix3d camera_from_world = rotation_matrix<double>(view.world_from_camera).transpose();
  std::vector<double> distances;
  for (const std::int64_t id : ids_) {
    const auto landmark = estimate.landmarks.find(id);
    const BundlePoint& point = *tracks_.at(id).point;
    if (landmark == estimate.landmarks.end() || point.kind == BundlePoint::Kind::fixed) continue;
    const auto now = point_in_view(landmark->second, estimate.belief, view);
    const auto then = camera.project(camera_from_world *
                                     scaled_vector(point, views_.at(point.host).position, view.position));
    if (!now || !then) continue;
    if (const auto projected = camera.project({now->x(), now->y(), 1}))
      distances.push_back((projected->pixel - then->pixel).norm());
  }
  return distances.empty() ? 0 : median(distances);
}

int Keyframes::returning_count(const std::vector<KeyframeMatch>& matches) const {
  const int first_in_window = last() + 1 - window_;
  return static_cast<int>(std::ranges::count_if(matches, [&](const KeyframeMatch& match) {
    const auto track = tracks_.find(match.id);
    return track != tracks_.end() && track->second.seen.back().view < first_in_window;
  }));
}

std::optional<Eigen::Vector3d> Keyframes::point_in_first_view(std::int64_t id) const {
  const auto track = tracks_.find(id);
  if (track == tracks_.end() || !track->second.point || track->second.point->host != views_.begin()->first)
    return std::nullopt;
  return track->second.point->value;
}

}  // namespace incognita
