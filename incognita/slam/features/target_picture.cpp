#include "incognita/slam/features/target_picture.hpp"

#include <stdexcept>

namespace incognita {

double correlation_with_picture(const Target& target, const Camera& camera, const Image& image,
                                const TargetPose& pose) {
  if (!target.picture) throw std::invalid_argument("the target has no picture");
  const auto& [picture, world_from_px] = *target.picture;
  const Eigen::Matrix3d camera_from_world = rotation_matrix(pose.world_from_camera).transpose();
  const int pixels = picture.width() * picture.height();
  Eigen::VectorXd wanted(pixels), observed_patch(pixels);
  int count = 0;
  for (int v = 0; v < picture.height(); ++v)
    for (int u = 0; u < picture.width(); ++u) {
      const Eigen::Vector3d at = world_from_px * Eigen::Vector3d(u, v, 1);
      const auto pixel = camera.project(camera_from_world * (at - pose.position));
      if (!pixel || !camera.contains(pixel->pixel)) continue;
      wanted[count] = picture(u, v);
      observed_patch[count++] = image.sample(pixel->pixel.x(), pixel->pixel.y());
    }
  if (count == 0 || 2 * count < pixels) return -1;
  const Eigen::VectorXd a = wanted.head(count).array() - wanted.head(count).mean(),
                        b = observed_patch.head(count).array() - observed_patch.head(count).mean();
  const double contrasts = a.norm() * b.norm();
  return contrasts > 1 ? a.dot(b) / contrasts : -1;
}

}  // namespace incognita
