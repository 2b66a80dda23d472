// A sheet of paper on a gray wall, photographed ray by ray.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "incognita/math/random.hpp"
#include "incognita/models/sensors/camera.hpp"
#include "incognita/vision/image.hpp"

namespace incognita::testing {

struct Sheet {
  Image image;  ///< of the whole paper
  double width_m = 0, height_m = 0;
};

struct SheetLight {
  double slope = 0;       ///< relative difference of the brightness of the left and right edge of the image
  double sigma_gray = 1;  ///< noise
};

/// The center of the sheet is the origin of the world, in the plane x = 0, upright, facing -x. 3x3 rays per pixel.
inline Image photograph_sheet(const Sheet& sheet, const Camera& camera, const Eigen::Vector3d& position,
                              const Eigen::Matrix3d& world_from_camera, const SheetLight& light = {}) {
  RandomStream random(1, "sheet");
  Image image(camera.width(), camera.height());
  for (int v = 0; v < image.height(); ++v)
    for (int u = 0; u < image.width(); ++u) {
      double sum = 0;
      for (int i = 0; i < 9; ++i) {
        const auto ray = camera.unproject({u + (i % 3 - 1) / 3.0, v + (i / 3 - 1) / 3.0});
        const Eigen::Vector3d along = world_from_camera * ray.value_or(Eigen::Vector3d(0, 0, 1));
        const double scale = along.x() > 0 ? -position.x() / along.x() : -1;
        const Eigen::Vector3d at = position + scale * along;
        const double right = 0.5 - at.y() / sheet.width_m, down = 0.5 - at.z() / sheet.height_m;
        const bool hit = scale > 0 && right > 0 && right < 1 && down > 0 && down < 1;
        sum += hit ? sheet.image.sample(right * sheet.image.width() - 0.5, down * sheet.image.height() - 0.5)
                   : 120;
      }
      const double lit = sum / 9 * (1 + light.slope * (static_cast<double>(u) / image.width() - 0.5));
      image(u, v) =
          static_cast<std::uint8_t>(std::clamp(lit + light.sigma_gray * random.normal(), 0.0, 255.0));
    }
  return image;
}

/// World from camera of a camera at `position` that looks at `at`, turned about its axis by `roll`, rad.
inline Eigen::Matrix3d gaze_at(const Eigen::Vector3d& at, const Eigen::Vector3d& position, double roll = 0) {
  const Eigen::Vector3d forward = (at - position).normalized(),
                        right = forward.cross(Eigen::Vector3d::UnitZ()).normalized();
  Eigen::Matrix3d R;
  R << right, forward.cross(right), forward;
  return R * Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitZ()).toRotationMatrix();
}

}  // namespace incognita::testing
