#include "incognita/slam/features/landmark_initialization.hpp"

#include <cmath>

namespace incognita {
namespace {

constexpr int boxes_tried = 15;  // per frame, until one is free of landmarks and contains a corner

bool near_any_match(const std::vector<Eigen::Vector2d>& measurements, const PixelBox& box, int margin) {
  for (const auto& at : measurements)
    if (at.x() > box.u - margin && at.x() < box.u + box.width + margin && at.y() > box.v - margin &&
        at.y() < box.v + box.height + margin)
      return true;
  return false;
}

/// Whether a corner of unknown depth stays in view over the look-ahead time, for any depth on its ray.
bool stays_in_view(const Eigen::Vector2d& pixel, const Camera& camera, const CameraState& now,
                   const InitializationSettings& initialization) {
  const auto ray = camera.unproject(pixel);
  if (!ray) return false;
  const CameraState later =
      FreeCameraMotion{}.f<double>(now, Eigen::Matrix<double, 6, 1>::Zero(), initialization.look_ahead_s);
  for (const double depth : {initialization.min_depth_m, initialization.max_depth_m}) {
    const Eigen::Vector3d point =
        Eigen::Vector3d(free_camera::position(now)) +
        rotation_matrix<double>(free_camera::orientation(now)) * ray->normalized() * depth;
    const auto projected = camera.project(PointLandmark::in_camera<double>(later, point));
    if (!projected || !camera.contains(projected->pixel, max_patch_size)) return false;
  }
  return true;
}

std::vector<Landmark::Particle> uniform_depths(const InitializationSettings& initialization,
                                               double ray_length) {
  // Settings give depths along the ray, particles along the optical axis (ray_length = |(x, y, 1)|)
  std::vector<Landmark::Particle> particles(initialization.particles);
  for (int i = 0; i < initialization.particles; ++i) {
    const double share =
        initialization.particles > 1 ? static_cast<double>(i) / (initialization.particles - 1) : 0.5;
    const double depth =
        initialization.min_depth_m + share * (initialization.max_depth_m - initialization.min_depth_m);
    particles[i] = {ray_length / depth, 1.0 / initialization.particles};
  }
  return particles;
}

}  // namespace

std::optional<PatchView> cut_view(const Image& image, const Eigen::Vector2d& pixel, const CameraState& from,
                                  const Camera& camera, const CameraSlamSettings& settings) {
  const int size = settings.search.patch_size_px;
  auto texture = cut_texture(image, pixel, 2 * size + 5, size / 2 + 1);
  const auto ray = camera.unproject(pixel);
  if (!texture || !ray) return std::nullopt;
  PatchView view{
      *std::move(texture), pixel, free_camera::position(from), free_camera::orientation(from), {}, 0};
  view.plane.facing = -(rotation_matrix(view.world_from_camera) * ray->normalized());
  view.plane.slope_cov = std::pow(settings.initialization.sigma_slope, 2) * Eigen::Matrix2d::Identity();
  view.plane.estimated_from = view.camera_position;
  return view;
}

std::optional<Eigen::Vector2d> find_new_corner(const Image& image, const Estimate& estimate,
                                               const Camera& camera, const CameraSlamSettings& settings,
                                               RandomStream& random) {
  const InitializationSettings& initialization = settings.initialization;
  const int rim = settings.search.patch_size_px + 2;  // a whole patch and a margin for its warp
  const int width = std::min(initialization.box_width_px, image.width() - 2 * rim);
  const int height = std::min(initialization.box_height_px, image.height() - 2 * rim);
  if (width < 1 || height < 1) return std::nullopt;
  const CameraState now = estimate.camera_state();
  // Occupied pixels: all landmarks predicted in view, lines, and landmarks initialized in this frame
  std::vector<Eigen::Vector2d> taken;
  for (const FeatureMatch& match : estimate.matches)
    taken.push_back(match.measured.value_or(match.predicted));
  for (const Landmark& landmark : estimate.catalog) {
    if (landmark.kind != Landmark::Kind::line && landmark.attempts > 0) continue;
    if (const auto at = position_of(landmark, estimate.belief))
      if (const auto projected = camera.project(PointLandmark::in_camera<double>(now, at->position)))
        taken.push_back(projected->pixel);
  }
  for (int i = 0; i < boxes_tried; ++i) {
    const PixelBox box{rim + random.below(image.width() - 2 * rim - width + 1),
                       rim + random.below(image.height() - 2 * rim - height + 1), width, height};
    if (near_any_match(taken, box, settings.search.patch_size_px / 2)) continue;
    const auto corner = strongest_corner(image, box, settings.search.patch_size_px);
    if (!corner || corner->strength < initialization.min_corner_strength) continue;
    std::optional<Eigen::Vector2d> center(std::in_place, corner->u, corner->v);
    if (initialization.center == InitializationSettings::Center::edges)
      center = center_of_corner(image, *center, settings.search.patch_size_px);
    if (!center || !stays_in_view(*center, camera, now, initialization)) continue;
    // The center may lie outside the box, on a corner that is already mapped
    const PixelBox there{static_cast<int>(std::lround(center->x())),
                         static_cast<int>(std::lround(center->y())), 1, 1};
    if (!near_any_match(taken, there, settings.search.patch_size_px / 2)) return center;
  }
  return std::nullopt;
}

bool initialize_landmark(const Image& image, const Eigen::Vector2d& pixel, Estimate& estimate,
                         const Camera& camera, const CameraSlamSettings& settings) {
  const InitializationSettings& initialization = settings.initialization;
  const CameraState from = estimate.camera_state();
  auto view = cut_view(image, pixel, from, camera, settings);
  const auto initialized =
      InverseDepthLandmark::initialize(camera, from, pixel, initialization.inverse_depth_per_m);
  if (!view || !initialized) return false;
  Landmark landmark;
  landmark.id = estimate.next_id++;
  landmark.initial_axes.world_from_initial_camera = initialized->world_from_initial_camera;
  landmark.view = *std::move(view);
  const double pixel_var = std::pow(settings.filter.sigma_pixel_px, 2);
  Eigen::Matrix<double, 6, 6> noise = pixel_var * initialized->Jz * initialized->Jz.transpose();
  if (initialization.method == InitializationSettings::Method::depth_line) {
    landmark.kind = Landmark::Kind::line;
    landmark.particles = uniform_depths(
        initialization, Eigen::Vector3d(initialized->landmark[3], initialized->landmark[4], 1).norm());
    const Belief::Parent parent{estimate.camera, initialized->Jv.topRows<5>()};
    // The initial position duplicates the camera position: regularization keeps the covariance positive definite
    Eigen::Matrix<double, 5, 5> line_noise = noise.topLeftCorner<5, 5>();
    line_noise.topLeftCorner<3, 3>() += 1e-8 * Eigen::Matrix3d::Identity();
    landmark.block =
        estimate.belief.augment(Chart::line(5), initialized->landmark.head<5>(), {&parent, 1}, line_noise);
  } else {
    landmark.kind = Landmark::Kind::inverse_depth;
    noise(5, 5) += std::pow(initialization.sigma_inverse_depth_per_m, 2);
    noise.topLeftCorner<3, 3>() += 1e-8 * Eigen::Matrix3d::Identity();
    const Belief::Parent parent{estimate.camera, initialized->Jv};
    landmark.block =
        estimate.belief.augment(InverseDepthLandmark::chart, initialized->landmark, {&parent, 1}, noise);
  }
  estimate.catalog.push_back(std::move(landmark));
  return true;
}

}  // namespace incognita
