#include "incognita/slam/features/recognition.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "incognita/slam/features/each_feature.hpp"
#include "incognita/slam/features/predict_matches.hpp"
#include "incognita/vision/corners.hpp"

namespace incognita {
namespace {

constexpr double new_view_rad = 0.26, new_view_scale = 1.3;  // change of direction or distance of a new view
constexpr std::size_t max_views = 6;                         // of a feature
constexpr int max_described_per_frame = 3;                   // each takes about 0.05 ms
constexpr int max_orientations = 2;
// Views are described at two scales, and so are corners: ratios of 1/1.5, 1 and 1.5, within the tolerance of 1.25 of a
// descriptor either way, cover the range within which patches match
constexpr double coarse_scale = 1.5;
constexpr int corner_margin_px = 8, corners_apart_px = 4;
constexpr double same_patch_px = 6;  // two corners nearer than this have nearly the same descriptors
constexpr double weaker_corners =
    0.2;  // than those that landmarks are initialized at: another view, another blur

Image shrunk(const Image& image, double factor) {
  const int width = static_cast<int>(std::lround(image.width() / factor)),
            height = static_cast<int>(std::lround(image.height() / factor));
  Image out(width, height);
  const cv::Mat from(image.height(), image.width(), CV_8UC1, const_cast<std::uint8_t*>(image.row(0)));
  cv::Mat to(height, width, CV_8UC1, out.row(0));
  cv::resize(from, to, to.size(), 0, 0, cv::INTER_AREA);
  return out;
}

/// The same point in an image of another size; pixel centers are at whole numbers.
Eigen::Vector2d shrunk(const Eigen::Vector2d& pixel, const Image& from, const Image& to) {
  const Eigen::Vector2d ratio(static_cast<double>(to.width()) / from.width(),
                              static_cast<double>(to.height()) / from.height());
  return ((pixel.array() + 0.5) * ratio.array() - 0.5).matrix();
}

std::vector<DescribedView::AtScale> descriptors_at(const Image& image, const Image& coarse,
                                                   const Eigen::Vector2d& pixel) {
  std::vector<Descriptor> found;
  describe(image, pixel, max_orientations, found);
  std::vector<DescribedView::AtScale> out;
  for (const Descriptor& descriptor : found) out.push_back({1, descriptor});
  found.clear();
  describe(coarse, shrunk(pixel, image, coarse), max_orientations, found);
  for (const Descriptor& descriptor : found) out.push_back({coarse_scale, descriptor});
  return out;
}

bool is_new_view(const Feature& feature, const Eigen::Vector3d& point, const Eigen::Vector3d& from) {
  return std::ranges::none_of(feature.described, [&](const DescribedView& view) {
    const Eigen::Vector3d now = point - from, then = point - view.camera_position;
    const double now_m = now.norm(), then_m = then.norm();
    return now.dot(then) > std::cos(new_view_rad) * now_m * then_m && now_m < new_view_scale * then_m &&
           then_m < new_view_scale * now_m;
  });
}

}  // namespace

void describe_new_views(const Image& image, const Estimate& estimate, TrackedCamera& camera) {
  const Eigen::Vector3d from = free_camera::position(camera.view.camera);
  std::optional<Image> coarse;
  int described = 0;
  for (const FeatureMatch& match : camera.matches) {
    if (match.outcome != MatchOutcome::matched || described == max_described_per_frame) continue;
    Feature& feature = camera.features.at(match.id);
    if (feature.described.size() >= max_views) continue;
    if (!is_new_view(feature, nominal_position(estimate.landmarks.at(match.id), estimate.belief), from))
      continue;
    if (!coarse) coarse = shrunk(image, coarse_scale);
    feature.described.push_back({from, free_camera::orientation(camera.view.camera), *match.measured,
                                 descriptors_at(image, *coarse, *match.measured)});
    ++described;
  }
}

namespace {

struct DescribedCorner {
  Eigen::Vector2d pixel;
  std::vector<DescribedView::AtScale> descriptors;
};

std::vector<DescribedCorner> describe_corners(const Image& image, const CameraSlamSettings& settings,
                                              int max_corners) {
  const Image coarse = shrunk(image, coarse_scale);
  const int window = settings.search.patch_size_px;
  std::vector<DescribedCorner> out;
  for (const Corner& corner :
       strong_corners(image, window, weaker_corners * settings.initialization.min_corner_strength,
                      corners_apart_px, corner_margin_px, max_corners)) {
    Eigen::Vector2d pixel(corner.u, corner.v);
    if (settings.initialization.center == InitializationSettings::Center::edges)
      pixel = center_of_corner(image, pixel, window).value_or(pixel);
    const bool is_known = std::ranges::any_of(
        out, [&](const DescribedCorner& other) { return (other.pixel - pixel).norm() < 1; });
    if (!is_known) out.push_back({pixel, descriptors_at(image, coarse, pixel)});
  }
  return out;
}

/// Axes of a patch in camera axes: along its orientation in the image, across it, and along the ray.
std::optional<Eigen::Matrix3d> axes_of_patch(const Camera& camera, const Eigen::Vector2d& pixel,
                                             double angle_rad) {
  const auto ray = camera.unproject(pixel);
  const auto beside = camera.unproject(pixel + Eigen::Vector2d(std::cos(angle_rad), std::sin(angle_rad)));
  if (!ray || !beside) return std::nullopt;
  Eigen::Matrix3d axes;
  axes.col(2) = ray->normalized();
  axes.col(0) = (*beside - *ray - axes.col(2) * axes.col(2).dot(*beside - *ray)).normalized();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  return axes;
}

/// The camera that sees a patch as `view` did, but for the pixel, the rotation in the image and the scale.
std::optional<CameraState> expected_camera(const Camera& camera, const Eigen::Vector3d& point,
                                           const DescribedView& view, const DescribedView::AtScale& then,
                                           const Eigen::Vector2d& pixel, const DescribedView::AtScale& now) {
  const auto axes_then = axes_of_patch(camera, view.pixel, then.descriptor.angle_rad),
             axes_now = axes_of_patch(camera, pixel, now.descriptor.angle_rad);
  if (!axes_then || !axes_now) return std::nullopt;
  const Eigen::Matrix3d world_from_camera =
      rotation_matrix(view.world_from_camera) * *axes_then * axes_now->transpose();
  const double distance_m = (point - view.camera_position).norm() * then.scale / now.scale;
  CameraState x = CameraState::Zero();
  x.head<3>() = point - distance_m * (world_from_camera * axes_now->col(2));
  x.segment<4>(3) = quaternion_from_matrix(world_from_camera);
  return x;
}

struct Alike {
  int distance = std::numeric_limits<int>::max();  ///< squared
  int corner = -1, view = -1, then = -1, now = -1;
};

/// The most alike pair of descriptors of a corner and a feature; `most`: the largest distance that counts.
Alike most_alike(const Feature& feature, const DescribedCorner& corner, int most) {
  Alike best;
  best.distance = most + 1;
  for (int view = 0; view < static_cast<int>(feature.described.size()); ++view) {
    const auto& descriptors = feature.described[static_cast<std::size_t>(view)].descriptors;
    for (int then = 0; then < static_cast<int>(descriptors.size()); ++then)
      for (int now = 0; now < static_cast<int>(corner.descriptors.size()); ++now) {
        const int distance =
            squared_distance(descriptors[static_cast<std::size_t>(then)].descriptor,
                             corner.descriptors[static_cast<std::size_t>(now)].descriptor, best.distance - 1);
        if (distance < best.distance) best = {distance, -1, view, then, now};
      }
  }
  return best;
}

struct Recognized {
  PointMatch match;
  int distance = 0, corner = 0;
  bool is_alone = false;  ///< no other corner is nearly as much like the landmark
};

/// Whether no corner elsewhere is nearly as alike as the most alike one, the first.
bool is_alone(const std::vector<Alike>& sorted, const std::vector<DescribedCorner>& corners, double ratio) {
  const auto pixel = [&](const Alike& a) { return corners[static_cast<std::size_t>(a.corner)].pixel; };
  return std::none_of(sorted.begin() + 1, sorted.end(), [&](const Alike& other) {
    return sorted.front().distance > ratio * ratio * other.distance &&
           (pixel(other) - pixel(sorted.front())).norm() > same_patch_px;
  });
}

/// The corners that are most like one landmark.
void recognize(const Landmark& landmark, const Feature& feature, const LandmarkPosition& at,
               const std::vector<DescribedCorner>& corners, const Camera& camera,
               const RecognitionLimits& limits, std::vector<Recognized>& out) {
  const int most = static_cast<int>(limits.max_distance * limits.max_distance);
  std::vector<Alike> alike;
  for (int c = 0; c < static_cast<int>(corners.size()); ++c) {
    Alike best = most_alike(feature, corners[static_cast<std::size_t>(c)], most);
    if (best.distance > most) continue;
    best.corner = c;
    alike.push_back(best);
  }
  std::stable_sort(alike.begin(), alike.end(),
                   [](const Alike& a, const Alike& b) { return a.distance < b.distance; });
  if (alike.empty()) return;
  const bool alone = is_alone(alike, corners, limits.distinctive_ratio);
  if (alike.size() > static_cast<std::size_t>(limits.candidates_per_landmark))
    alike.resize(static_cast<std::size_t>(limits.candidates_per_landmark));
  for (const Alike& a : alike) {
    const DescribedCorner& corner = corners[static_cast<std::size_t>(a.corner)];
    const DescribedView& view = feature.described[static_cast<std::size_t>(a.view)];
    PointMatch match{landmark.id, at.position, at.covariance, corner.pixel, landmark.first_view};
    match.expected =
        expected_camera(camera, match.point, view, view.descriptors[static_cast<std::size_t>(a.then)],
                        corner.pixel, corner.descriptors[static_cast<std::size_t>(a.now)]);
    if (match.expected) out.push_back({match, a.distance, a.corner, alone && &a == &alike.front()});
  }
}

}  // namespace

std::vector<PointMatch> recognize_landmarks(const Image& image, const Estimate& estimate,
                                            const TrackedCamera& camera, const RecognitionLimits& limits) {
  const std::vector<DescribedCorner> corners = describe_corners(image, camera.settings, limits.max_corners);
  std::vector<Recognized> all;
  for_each_feature(estimate, camera.features, [&](const Landmark& landmark, const Feature& feature) {
    if (feature.described.empty() || !(landmark.fixed || landmark.mapped())) return;
    const auto at = position_of(landmark, estimate);
    if (!at) return;
    const double distance_m =
        (Eigen::Vector3d(at->position) - feature.described.back().camera_position).norm();
    if (std::sqrt(at->covariance.trace()) > limits.max_sigma_share * distance_m) return;
    recognize(landmark, feature, *at, corners, camera.camera, limits, all);
  });
  std::stable_sort(all.begin(), all.end(),
                   [](const Recognized& a, const Recognized& b) { return a.distance < b.distance; });
  const double ratio2 = limits.distinctive_ratio * limits.distinctive_ratio;
  std::vector<int> landmarks(corners.size(), 0), next(corners.size(), std::numeric_limits<int>::max());
  for (auto at = all.rbegin(); at != all.rend();
       ++at) {  // from the least alike: `next` is of the landmarks after it
    const auto corner = static_cast<std::size_t>(at->corner);
    at->match.is_distinctive = at->is_alone && at->distance < ratio2 * next[corner];
    next[corner] = at->distance;
  }
  std::vector<PointMatch> out;
  for (Recognized& recognized : all)
    if (landmarks[static_cast<std::size_t>(recognized.corner)]++ < limits.landmarks_per_corner)
      out.push_back(std::move(recognized.match));
  return out;
}

}  // namespace incognita
