#include "incognita/slam/features/align_rotation.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <cmath>

namespace incognita {
namespace {

constexpr int max_iterations = 12;
constexpr double min_overlap = 0.5;      // of the pixels
constexpr double done_below_rad = 1e-4;  // a tenth of a pixel of a camera with 1000 px focal length
constexpr double huber = 0.5;  // standard deviations of the image: what moves or is occluded counts less

/// Normal equations of the rotation vector that is applied after the current rotation, and the mean robust cost.
struct Equations {
  Eigen::Matrix3d H = Eigen::Matrix3d::Zero();
  Eigen::Vector3d g = Eigen::Vector3d::Zero();
  double cost = 0;
  int pixels = 0;
};

Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& v) {
  return (Eigen::Matrix3d() << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0).finished();
}

void add_pixel(Equations& equations, double value_before, const SmallImage& now, const Camera& camera,
               const Eigen::Vector3d& ray_now) {
  const auto projected = camera.project(ray_now);
  if (!projected) return;
  const auto sample = now.sample(now.from_image(projected->pixel));
  if (!sample) return;
  const double residual = value_before - sample->value;
  const double weight = std::abs(residual) <= huber ? 1 : huber / std::abs(residual);
  // d(exp(w) ray) / dw = -[ray x]
  const Eigen::RowVector3d J = sample->gradient / now.scale() * projected->J * -cross_matrix(ray_now);
  equations.H.noalias() += weight * J.transpose() * J;
  equations.g.noalias() += weight * residual * J.transpose();
  equations.cost += weight * (2 - weight) * residual * residual;
  ++equations.pixels;
}

std::optional<Equations> linearize(const SmallImage& before, const SmallImage& now,
                                   const std::vector<Eigen::Vector3d>& rays, const Camera& camera,
                                   const Eigen::Matrix3d& rotation) {
  Equations equations;
  std::size_t i = 0;
  for (int v = 0; v < before.height(); ++v)
    for (int u = 0; u < before.width(); ++u, ++i)
      if (rays[i].z() != 0) add_pixel(equations, before(u, v), now, camera, rotation * rays[i].normalized());
  if (equations.pixels < min_overlap * static_cast<double>(rays.size())) return std::nullopt;
  equations.cost /= equations.pixels;
  return equations;
}

Eigen::Matrix3d exponential(const Eigen::Vector3d& w) {
  const double angle = w.norm();
  if (angle < 1e-12) return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd(angle, w / angle).toRotationMatrix();
}

}  // namespace

std::vector<Eigen::Vector3d> rays_of(const SmallImage& image, const Camera& camera) {
  std::vector<Eigen::Vector3d> rays;
  for (int v = 0; v < image.height(); ++v)
    for (int u = 0; u < image.width(); ++u)
      rays.push_back(camera.unproject(image.to_image(u, v)).value_or(Eigen::Vector3d::Zero()));
  return rays;
}

std::optional<RotationAlignment> align_rotation(const SmallImage& before, const SmallImage& now,
                                                const std::vector<Eigen::Vector3d>& rays,
                                                const Camera& camera) {
  RotationAlignment result;
  auto equations = linearize(before, now, rays, camera, result.rotation);
  if (!equations) return std::nullopt;
  result.rms_initial = result.rms = std::sqrt(equations->cost);
  double damping = 1e-3;
  for (int i = 0; i < max_iterations; ++i) {
    Eigen::Matrix3d H = equations->H;
    H.diagonal() *= 1 + damping;
    const Eigen::LLT<Eigen::Matrix3d> llt(H);
    if (llt.info() != Eigen::Success) return std::nullopt;
    const Eigen::Vector3d step = llt.solve(equations->g);
    const Eigen::Matrix3d next = exponential(step) * result.rotation;
    const auto there = linearize(before, now, rays, camera, next);
    if (there && there->cost < equations->cost) {
      equations = there;
      result.rotation = next;
      result.rms = std::sqrt(there->cost);
      damping = std::max(damping / 10, 1e-6);
      if (step.norm() < done_below_rad) break;
    } else {
      damping *= 10;
      if (damping > 1e3 || step.norm() < done_below_rad) break;
    }
  }
  return result;
}

}  // namespace incognita
