#include "incognita/io/recordings/bags/bag_camera.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace incognita {
namespace {

bool is_equidistant(const bags::CameraInfoMessage& info) {
  return info.distortion_model == "equidistant" || info.distortion_model == "fisheye";
}

bool has_zeros_from(const std::vector<double>& d, std::size_t first) {
  return std::all_of(d.begin() + static_cast<std::ptrdiff_t>(std::min(first, d.size())), d.end(),
                     [](double k) { return k == 0; });
}

/// `rational_polynomial` is k1 k2 p1 p2 k3 k4 k5 k6, which is `plumb_bob` if the last three are 0.
std::string why_lens_unfit(const bags::CameraInfoMessage& info) {
  const std::string& model = info.distortion_model;
  if (is_equidistant(info))
    return has_zeros_from(info.d, 4) ? "" : fmt::format("{} has {} coefficients", model, info.d.size());
  if (has_zeros_from(info.d, 0)) return "";
  if (model != "plumb_bob" && model != "rational_polynomial")
    return fmt::format("distortion_model is `{:.40}`", model);
  return has_zeros_from(info.d, 5) ? ""
                                   : fmt::format("{} has more than five coefficients that are not 0", model);
}

std::string why_info_unfit(const bags::CameraInfoMessage& info, bool is_rectified) {
  const bool is_part = info.roi_x != 0 || info.roi_y != 0 ||
                       (info.roi_width != 0 && info.roi_width != info.width) ||
                       (info.roi_height != 0 && info.roi_height != info.height);
  if (is_part || info.binning_x > 1 || info.binning_y > 1)
    return "the images are a region of interest, or binned";
  if (is_rectified) return "";
  if (info.k[1] != 0) return "K has a skew";
  return why_lens_unfit(info);
}

decltype(CameraSettings::model) lens_in(const bags::CameraInfoMessage& info) {
  std::vector<double> d = info.d;
  d.resize(5);
  if (is_equidistant(info)) {
    FisheyeLens lens;
    lens.k1 = d[0], lens.k2 = d[1], lens.k3 = d[2], lens.k4 = d[3];
    return lens;
  }
  PinholeLens lens;
  lens.k1 = d[0], lens.k2 = d[1], lens.p1 = d[2], lens.p2 = d[3], lens.k3 = d[4];
  return lens;
}

bool is_plausible(const CameraSettings& camera) {
  return camera.fu_px > 0 && camera.fv_px > 0 && camera.fu_px < 1e6 && camera.fv_px < 1e6 &&
         std::isfinite(camera.u0_px) && std::isfinite(camera.v0_px);
}

}  // namespace

std::optional<CalibratedCamera> calibrated_camera(const bags::CameraInfoMessage& info, bool is_rectified,
                                                  const std::string& name) {
  constexpr std::uint32_t most_px = 16384;  // as camera.width_px
  const bool are_finite =
      std::all_of(info.d.begin(), info.d.end(), [](double k) { return std::isfinite(k); });
  if (info.width < 1 || info.width > most_px || info.height < 1 || info.height > most_px || !are_finite)
    return std::nullopt;
  CalibratedCamera found{name, {}, why_info_unfit(info, is_rectified)};
  CameraSettings& camera = found.camera;
  camera.width_px = static_cast<int>(info.width), camera.height_px = static_cast<int>(info.height);
  camera.model = is_rectified ? PinholeLens{} : lens_in(info);
  camera.fu_px = is_rectified ? info.p[0] : info.k[0];
  camera.fv_px = is_rectified ? info.p[5] : info.k[4];
  camera.u0_px = is_rectified ? info.p[2] : info.k[2];
  camera.v0_px = is_rectified ? info.p[6] : info.k[5];
  if (!is_plausible(camera)) return std::nullopt;
  return found;
}

bool has_rectified_images(const std::string& topic) {
  const std::size_t last = topic.rfind("/image");  // /camera/image_rect_color/compressed
  return last != std::string::npos && topic.compare(last, 11, "/image_rect") == 0;
}

}  // namespace incognita
