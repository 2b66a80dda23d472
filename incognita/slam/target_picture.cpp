#include "incognita/slam/target_picture.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace incognita {
namespace {

class Correlation {
 public:
  void add(double a, double b) {
    n_ += 1, a_ += a, b_ += b;
    aa_ += a * a, bb_ += b * b, ab_ += a * b;
  }
  int samples() const { return n_; }
  double value() const {
    const double variances = (aa_ - a_ * a_ / n_) * (bb_ - b_ * b_ / n_);
    return variances > 1 ? (ab_ - a_ * b_ / n_) / std::sqrt(variances) : -1;
  }

 private:
  int n_ = 0;
  double a_ = 0, b_ = 0, aa_ = 0, bb_ = 0, ab_ = 0;
};

}  // namespace

double likeness_to_picture(const Target& target, const Camera& camera, const Image& image,
                           const TargetPose& pose) {
  if (!target.picture) throw std::invalid_argument("the target has no picture");
  const auto& [picture, world_from_px] = *target.picture;
  const Eigen::Matrix3d camera_from_world = rotation_matrix(pose.world_from_camera).transpose();
  Correlation seen;
  for (int v = 0; v < picture.height(); ++v)
    for (int u = 0; u < picture.width(); ++u) {
      const Eigen::Vector3d at = world_from_px * Eigen::Vector3d(u, v, 1);
      const auto pixel = camera.project(camera_from_world * (at - pose.position));
      if (pixel && camera.contains(pixel->pixel))
        seen.add(picture(u, v), image.sample(pixel->pixel.x(), pixel->pixel.y()));
    }
  return 2 * seen.samples() < picture.width() * picture.height() ? -1 : seen.value();
}

}  // namespace incognita
