#include "incognita/io/scenario/camera.hpp"

#include <fmt/format.h>

#include "incognita/messages/unfit_setting.hpp"
#include "incognita/models/sensors/fisheye_camera.hpp"
#include "incognita/models/sensors/pinhole_camera.hpp"
#include "incognita/models/sensors/wide_angle_camera.hpp"

namespace incognita {
namespace {

void need_inside(double value, int size, const char* key, const char* size_key) {
  if (value > 0 && value < size) return;
  throw UnfitSetting({key}, fmt::format("must lie inside the image, 0 to {} ({})", size, size_key));
}

/// Real lenses have a ray for every pixel at least half-way from the principal point to each edge.
void need_rays(const Camera& camera, const CameraSettings& s, const char* key) {
  const Eigen::Vector2d center(s.u0_px, s.v0_px);
  const Eigen::Vector2d edges[] = {
      {0, s.v0_px}, {s.width_px - 1.0, s.v0_px}, {s.u0_px, 0}, {s.u0_px, s.height_px - 1.0}};
  for (const Eigen::Vector2d& edge : edges) {
    const Eigen::Vector2d pixel = (center + edge) / 2;
    if (camera.unproject(pixel)) continue;
    throw UnfitSetting(
        {key}, fmt::format("must leave a ray to every pixel half-way to the edges: none reaches pixel "
                           "({:.1f}, {:.1f}) (is its unit right?)",
                           pixel.x(), pixel.y()));
  }
}

}  // namespace

Camera make_camera(const CameraSettings& s) {
  need_inside(s.u0_px, s.width_px, "camera.u0_px", "camera.width_px");
  need_inside(s.v0_px, s.height_px, "camera.v0_px", "camera.height_px");
  if (const auto* lens = std::get_if<WideAngleLens>(&s.model)) {
    const Camera camera =
        WideAngleCamera{s.width_px, s.height_px, s.fu_px, s.fv_px, s.u0_px, s.v0_px, lens->kd1_per_px2};
    need_rays(camera, s, "camera.kd1_per_px2");
    return camera;
  }
  if (const auto* lens = std::get_if<FisheyeLens>(&s.model)) {
    const Camera camera = FisheyeCamera{s.width_px, s.height_px, s.fu_px,  s.fv_px,  s.u0_px,
                                        s.v0_px,    lens->k1,    lens->k2, lens->k3, lens->k4};
    need_rays(camera, s, "camera.k1");
    return camera;
  }
  const auto& lens = std::get<PinholeLens>(s.model);
  const Camera camera = PinholeCamera{s.width_px, s.height_px, s.fu_px, s.fv_px, s.u0_px, s.v0_px,
                                      lens.k1,    lens.k2,     lens.p1, lens.p2, lens.k3};
  need_rays(camera, s, "camera.k1");
  return camera;
}

}  // namespace incognita
