// Checks that the camera models share.
#pragma once

#include <cmath>
#include <stdexcept>
#include <string>

namespace incognita {

/// Throws std::invalid_argument, with `what` is required and the value, unless `ok`.
inline void need(bool ok, const char* what, double value) {
  if (!ok) throw std::invalid_argument(std::string(what) + ", got " + std::to_string(value));
}

/// Image size (px), focal lengths fu, fv (px) and principal point u0, v0 (px) of any camera model.
template <class Model>
void check_image(const Model& camera) {
  need(camera.width >= 16, "camera width_px must be at least 16", camera.width);
  need(camera.height >= 16, "camera height_px must be at least 16", camera.height);
  need(std::isfinite(camera.fu) && camera.fu > 0, "camera fu_px must be positive", camera.fu);
  need(std::isfinite(camera.fv) && camera.fv > 0, "camera fv_px must be positive", camera.fv);
  need(std::isfinite(camera.u0) && camera.u0 > 0 && camera.u0 < camera.width,
       "camera u0_px must lie inside the image width", camera.u0);
  need(std::isfinite(camera.v0) && camera.v0 > 0 && camera.v0 < camera.height,
       "camera v0_px must lie inside the image height", camera.v0);
}

}  // namespace incognita
