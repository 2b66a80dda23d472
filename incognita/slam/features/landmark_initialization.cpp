#include "incognita/slam/features/landmark_initialization.hpp"

#include <algorithm>
#include <cmath>

#include "incognita/slam/features/loop_closure.hpp"
#include "incognita/slam/mapper/landmarks.hpp"

namespace incognita {
namespace {

constexpr int boxes_tried = 15;  // per frame, until one is free of landmarks and contains a corner

/// Where landmarks are in the image, px, and in the frame of the camera, m.
struct Occupied {
  std::vector<Eigen::Vector2d> pixels;
  std::vector<Eigen::Vector3d> points;

  void add(const Eigen::Vector2d& pixel, const Camera& camera, double distance_m) {
    pixels.push_back(pixel);
    if (const auto ray = camera.unproject(pixel)) points.push_back(distance_m * ray->normalized());
  }
};

bool near_any(const std::vector<Eigen::Vector2d>& pixels, const PixelBox& box, int margin) {
  return std::ranges::any_of(pixels, [&](const Eigen::Vector2d& at) {
    return at.x() > box.u - margin && at.x() < box.u + box.width + margin && at.y() > box.v - margin &&
           at.y() < box.v + box.height + margin;
  });
}

/// The look-ahead time, less where the image moves fast: by at most a quarter of the field of view.
double look_ahead_s(const Camera& camera, const CameraState& now, double median_depth_m,
                    const InitializationSettings& initialization) {
  constexpr double most_share = 0.25;
  const double middle = camera.height() / 2.0;
  const auto left = camera.unproject({0, middle}), right = camera.unproject({camera.width() - 1.0, middle});
  const double rate =
      free_camera::angular_rate(now).norm() + free_camera::velocity(now).norm() / median_depth_m;
  if (!left || !right || rate == 0) return initialization.look_ahead_s;
  const double field_rad = std::acos(left->normalized().dot(right->normalized()));
  return std::min(initialization.look_ahead_s, most_share * field_rad / rate);
}

/// Whether a corner of unknown depth stays in view over the look-ahead time, at half to four times the median depth.
bool stays_in_view(const Eigen::Vector2d& pixel, const TrackedCamera& tracked) {
  const Camera& camera = tracked.camera;
  const CameraState& now = tracked.view.camera;
  const InitializationSettings& initialization = tracked.settings.initialization;
  // Appendix C places boxes at random and looks ahead for a fixed time and range of depths
  const bool as_in_thesis = initialization.selection == InitializationSettings::Selection::random_box;
  const double nearest_m = as_in_thesis ? initialization.min_depth_m : 0.5 * tracked.median_depth_m;
  const double farthest_m = as_in_thesis ? initialization.max_depth_m : 4 * tracked.median_depth_m;
  const double time_s = as_in_thesis ? initialization.look_ahead_s
                                     : look_ahead_s(camera, now, tracked.median_depth_m, initialization);
  const auto ray = camera.unproject(pixel);
  if (!ray) return false;
  const CameraState later = FreeCameraMotion{}.f<double>(now, Eigen::Matrix<double, 6, 1>::Zero(), time_s);
  for (const double depth : {nearest_m, farthest_m}) {
    const Eigen::Vector3d point =
        Eigen::Vector3d(free_camera::position(now)) +
        rotation_matrix<double>(free_camera::orientation(now)) * ray->normalized() * depth;
    const auto projected = camera.project(PointLandmark::in_camera<double>(later, point));
    if (!projected || !camera.contains(projected->pixel, max_patch_size)) return false;
  }
  return true;
}

/// Settings give depths along the ray, hypotheses along the optical axis.
std::vector<DepthHypothesis> depths_on(const InverseDepthLandmark::State& ray,
                                       const InitializationSettings& initialization) {
  return uniform_depths(initialization.depth_range(), Eigen::Vector3d(ray[3], ray[4], 1).norm());
}

/// All landmarks predicted in view, rays, and landmarks initialized in this frame. Landmarks that returned and are missed are
/// probably elsewhere.
Occupied occupied(const Estimate& estimate, const TrackedCamera& tracked) {
  Occupied taken;
  const Camera& camera = tracked.camera;
  const Eigen::Vector3d from = free_camera::position(tracked.view.camera);
  const MissedLandmarks missed = missed_landmarks(tracked);
  for (const FeatureMatch& match : tracked.matches)
    if (!missed.may_be_right(match.id))
      taken.add(match.measured.value_or(match.predicted), camera, (match.point - from).norm());
  for (const auto& [id, feature] : tracked.features) {
    const Landmark& landmark = estimate.landmarks.at(id);
    if (landmark.form.kind != LandmarkParametrization::Kind::ray && feature.attempts > 0) continue;
    if (const auto at = current_position(estimate, landmark, feature))
      if (const auto projected = camera.project(PointLandmark::in_camera<double>(tracked.view.camera, *at)))
        taken.add(projected->pixel, camera, (*at - from).norm());
  }
  return taken;
}

/// Side of the textures, px: as much as aligning a patch needs at the greatest change of distance, map.max_scale, if the camera is not
/// turned about its optical axis.
int texture_side(const CameraSlamSettings& settings) {
  const double half = settings.search.patch_size_px / 2 + 2.5;
  return 2 * static_cast<int>(std::ceil(half * std::min(settings.map.max_scale, 4.0))) + 1;
}

}  // namespace

std::optional<PatchView> cut_view(const ImagePyramid& image, const Eigen::Vector2d& pixel,
                                  const CameraState& from, const Camera& camera,
                                  const CameraSlamSettings& settings) {
  const int side = texture_side(settings), core = settings.search.patch_size_px / 2 + 1;
  auto texture = cut_texture(image.image(), pixel, side, core);
  const auto ray = camera.unproject(pixel);
  if (!texture || !ray) return std::nullopt;
  PatchView view{
      *std::move(texture), {}, pixel, free_camera::position(from), free_camera::orientation(from), {}};
  for (int level = 1; level < image.levels(); ++level) {
    auto coarse = cut_texture(image.image(level), at_level(pixel, level), side, core);
    if (!coarse) break;
    view.coarse.push_back(*std::move(coarse));
  }
  view.plane.facing = -(rotation_matrix(view.world_from_camera) * ray->normalized());
  view.plane.slope_cov = std::pow(settings.initialization.sigma_slope, 2) * Eigen::Matrix2d::Identity();
  view.plane.estimated_from = view.camera_position;
  return view;
}

namespace {

/// The center of a patch at a corner; nothing if it is on a landmark, or soon out of view.
std::optional<Eigen::Vector2d> patch_center(const Image& image, const Corner& corner,
                                            const TrackedCamera& camera, const Occupied& taken,
                                            int min_distance_px) {
  const InitializationSettings& initialization = camera.settings.initialization;
  if (corner.strength < initialization.min_corner_strength) return std::nullopt;
  std::optional<Eigen::Vector2d> center(std::in_place, corner.u, corner.v);
  if (initialization.center == InitializationSettings::Center::edges)
    center = center_of_corner(image, *center, camera.settings.search.patch_size_px);
  if (!center || !stays_in_view(*center, camera)) return std::nullopt;
  // The center may lie outside the box, on a corner that is already mapped
  const PixelBox there{static_cast<int>(std::lround(center->x())), static_cast<int>(std::lround(center->y())),
                       1, 1};
  if (near_any(taken.pixels, there, min_distance_px)) return std::nullopt;
  return center;
}

}  // namespace

int cell_of_wanted_px(const TrackedCamera& camera) {
  constexpr double cells_per_landmark = 2;
  const int rim = camera.settings.search.patch_size_px + 2;
  const double width = camera.camera.width() - 2 * rim, height = camera.camera.height() - 2 * rim;
  const double cells = cells_per_landmark * std::max(1, camera.settings.map.wanted_visible);
  return static_cast<int>(std::sqrt(std::max(0.0, width * height) / cells));
}

bool is_covered(const Eigen::Vector3d& ray, std::span<const Eigen::Vector3d> landmarks, double gap_m) {
  const Eigen::Vector3d direction = ray.normalized();
  return std::ranges::any_of(landmarks, [&](const Eigen::Vector3d& landmark) {
    return (landmark.norm() * direction - landmark).norm() < gap_m / 2;
  });
}

namespace {

/// The strongest corner of each cell of a grid over the image that holds no landmark, the strongest first.
std::vector<Corner> corners_of_cells(const Image& image, const Occupied& taken, int patch, int side) {
  const int rim = patch + 2, right = image.width() - rim, bottom = image.height() - rim;
  if (right <= rim || bottom <= rim) return {};
  thread_local CornerMap map;
  map.assign(image, patch);
  std::vector<Corner> corners;
  for (int v = rim; v < bottom; v += side)
    for (int u = rim; u < right; u += side) {
      const PixelBox cell{u, v, std::min(side, right - u), std::min(side, bottom - v)};
      if (near_any(taken.pixels, cell, 0)) continue;
      if (const auto corner = map.strongest(cell)) corners.push_back(*corner);
    }
  std::stable_sort(corners.begin(), corners.end(),
                   [](const Corner& a, const Corner& b) { return a.strength > b.strength; });
  return corners;
}

}  // namespace

std::vector<Eigen::Vector2d> find_new_corners(const Image& image, const Estimate& estimate,
                                              const TrackedCamera& camera, int count, int cell_px,
                                              double gap_m) {
  const int patch = camera.settings.search.patch_size_px;
  Occupied taken = occupied(estimate, camera);
  std::vector<Eigen::Vector2d> found;
  for (const Corner& corner : corners_of_cells(image, taken, patch, std::max(patch + 4, cell_px))) {
    if (static_cast<int>(found.size()) == count) break;
    const auto center = patch_center(image, corner, camera, taken, patch);
    if (!center || is_covered(*camera.camera.unproject(*center), taken.points, gap_m)) continue;
    found.push_back(*center);
    taken.add(*center, camera.camera, camera.median_depth_m);
  }
  return found;
}

std::optional<Eigen::Vector2d> find_new_corner(const Image& image, const Estimate& estimate,
                                               const TrackedCamera& camera, RandomStream& random) {
  const InitializationSettings& initialization = camera.settings.initialization;
  const int patch = camera.settings.search.patch_size_px;
  const int rim = patch + 2;  // a whole patch and a margin for its warp
  const int width = std::min(initialization.box_width_px, image.width() - 2 * rim);
  const int height = std::min(initialization.box_height_px, image.height() - 2 * rim);
  if (width < 1 || height < 1) return std::nullopt;
  const Occupied taken = occupied(estimate, camera);
  for (int i = 0; i < boxes_tried; ++i) {
    const PixelBox box{rim + random.below(image.width() - 2 * rim - width + 1),
                       rim + random.below(image.height() - 2 * rim - height + 1), width, height};
    if (near_any(taken.pixels, box, patch / 2)) continue;
    const auto corner = strongest_corner(image, box, patch);
    if (!corner) continue;
    if (const auto center = patch_center(image, *corner, camera, taken, patch / 2)) return center;
  }
  return std::nullopt;
}

namespace {

/// Five errors of a ray, or six with the depth.
NewLandmark on_ray(const InverseDepthLandmark::Initialization& initialized, const TrackedCamera& camera,
                   int errors) {
  Eigen::Matrix<double, 6, 6> noise = camera.pixel_var() * initialized.Jz * initialized.Jz.transpose();
  noise(5, 5) += std::pow(camera.depth_prior().sigma, 2);
  // The initial position duplicates the camera position: regularization keeps the covariance positive definite
  noise.topLeftCorner<3, 3>() += 1e-8 * Eigen::Matrix3d::Identity();
  const Viewpoint& view = camera.view;
  const SmallMatrix Jv = view.by_body.size() == 0 ? SmallMatrix(initialized.Jv)
                                                  : SmallMatrix(initialized.Jv.leftCols<6>() * view.by_body);
  return {Chart::line(errors), initialized.landmark.head(errors), view.body, Jv.topRows(errors),
          noise.topLeftCorner(errors, errors)};
}

}  // namespace

bool initialize_from_image(const ImagePyramid& image, const Eigen::Vector2d& pixel, Estimate& estimate,
                           TrackedCamera& camera) {
  const InitializationSettings& initialization = camera.settings.initialization;
  auto view = cut_view(image, pixel, camera.view.camera, camera.camera, camera.settings);
  const auto initialized =
      InverseDepthLandmark::initialize(camera.camera, camera.view.camera, pixel, camera.depth_prior().mean);
  if (!view || !initialized) return false;
  const bool as_line = initialization.method == InitializationSettings::Method::depth_line;
  Landmark landmark;
  landmark.id = new_id(estimate);
  landmark.camera = camera.index;
  landmark.first_view = view->camera_position;
  landmark.form = {
      as_line ? LandmarkParametrization::Kind::ray : LandmarkParametrization::Kind::inverse_depth,
      initialized->world_from_initial_camera};
  Feature feature;
  feature.view = *std::move(view);
  if (as_line) feature.depths = depths_on(initialized->landmark, initialization);
  camera.features.emplace(landmark.id, std::move(feature));
  add_landmark(estimate, std::move(landmark), on_ray(*initialized, camera, as_line ? 5 : 6));
  return true;
}

void add_anchor(const Eigen::Vector3d& position, PatchView view, Estimate& estimate, TrackedCamera& camera) {
  Landmark anchor;
  anchor.id = new_id(estimate);
  anchor.fixed = true;
  anchor.position = position;
  anchor.camera = camera.index;
  anchor.first_view = view.camera_position;
  camera.features[anchor.id].view = std::move(view);
  estimate.landmarks.emplace(anchor.id, std::move(anchor));
}

}  // namespace incognita
