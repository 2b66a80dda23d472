// EuRoC's sensor.yaml of a camera, https://projects.asl.ethz.ch/datasets/doku.php?id=kmavvisualinertialdatasets
#include <fmt/format.h>

#include "incognita/io/calibrations/calibration_readers.hpp"
#include "incognita/io/calibrations/euroc_sensor.hpp"

namespace incognita {
namespace {

/// Whether the distortion is that of the `fisheye` model, by the words of Kalibr and of OpenCV.
bool is_fisheye(const YamlMap& file) {
  const std::string lens = file.word("distortion_model");
  return lens == "equidistant" || lens == "fisheye";
}

std::string euroc_lens(CameraSettings& camera, const YamlMap& file, const std::vector<double>& distortion) {
  const std::string model = file.word("camera_model"), lens = file.word("distortion_model");
  const bool radial_tangential = lens == "radial-tangential" || lens == "radtan" || lens == "plumb_bob" ||
                                 lens == "none" || lens.empty();
  if (model != "pinhole") return fmt::format("camera_model is `{}`", model);
  if (!radial_tangential && !is_fisheye(file)) return fmt::format("distortion_model is `{}`", lens);
  return set_lens(camera, is_fisheye(file), distortion);
}

}  // namespace

bool is_euroc(const YamlMap& map) {
  return map.has("camera_model") && map.has("intrinsics") && map.has("resolution");
}

CalibratedCamera camera_in_euroc_sensor(const YamlMap& map, const std::filesystem::path& file) {
  CalibratedCamera found{file, {}, ""};
  CameraSettings& camera = found.camera;
  const std::vector<double> distortion =
      map.has("distortion_coefficients") ? map.matrix("distortion_coefficients") : std::vector<double>{};
  found.unfit = euroc_lens(camera, map, distortion);
  if (!found.unfit.empty()) return found;
  const std::vector<double> f = map.numbers("intrinsics"), size = map.numbers("resolution");
  if (f.size() != 4)
    map.refuse("intrinsics", fmt::format("must be fu, fv, cu, cv, and has {} numbers", f.size()));
  if (size.size() != 2 || !(size[0] >= 1 && size[0] <= 1e5 && size[1] >= 1 && size[1] <= 1e5))
    map.refuse("resolution", "must be width and height in px");
  camera.width_px = static_cast<int>(size[0]), camera.height_px = static_cast<int>(size[1]);
  camera.fu_px = f[0], camera.fv_px = f[1], camera.u0_px = f[2], camera.v0_px = f[3];
  return found;
}

CalibrationFile read_euroc(const YamlMap& map, const std::filesystem::path& file) {
  CalibrationFile found{CalibrationFormat::euroc, camera_in_euroc_sensor(map, file), {}};
  if (map.has("T_BS")) found.notes.push_back("the extrinsics T_BS are not used");
  return found;
}

}  // namespace incognita
