#include "incognita/io/scenario/camera.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "incognita/models/pinhole_camera.hpp"
#include "incognita/models/wide_angle_camera.hpp"

namespace incognita {
namespace {

/// Real lenses have a ray for every pixel at least half-way from the principal point to each edge.
void need_rays(const Camera& camera, const CameraSettings& s, const char* key, double value) {
  const Eigen::Vector2d center(s.u0_px, s.v0_px);
  const Eigen::Vector2d edges[] = {
      {0, s.v0_px}, {s.width_px - 1.0, s.v0_px}, {s.u0_px, 0}, {s.u0_px, s.height_px - 1.0}};
  for (const Eigen::Vector2d& edge : edges) {
    const Eigen::Vector2d pixel = (center + edge) / 2;
    if (camera.unproject(pixel)) continue;
    throw std::invalid_argument(fmt::format(
        "camera {} must leave a ray to every pixel half-way to the edges: none reaches pixel ({:.1f}, "
        "{:.1f}) with {} (is its unit right?)",
        key, pixel.x(), pixel.y(), value));
  }
}

}  // namespace

Camera make_camera(const CameraSettings& s) {
  if (s.model == "wide-angle") {
    const Camera camera =
        WideAngleCamera{s.width_px, s.height_px, s.fu_px, s.fv_px, s.u0_px, s.v0_px, s.kd1_per_px2};
    need_rays(camera, s, "kd1_per_px2", s.kd1_per_px2);
    return camera;
  }
  if (s.model == "pinhole") {
    const Camera camera = PinholeCamera{s.width_px, s.height_px, s.fu_px, s.fv_px, s.u0_px, s.v0_px,
                                        s.k1,       s.k2,        s.p1,    s.p2,    s.k3};
    need_rays(camera, s, "k1", s.k1);
    return camera;
  }
  throw std::invalid_argument("camera model must be `wide-angle` or `pinhole`, got " + s.model);
}

}  // namespace incognita
