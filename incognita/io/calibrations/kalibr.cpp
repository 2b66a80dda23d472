// Kalibr's camchain.yaml: a section per camera. https://github.com/ethz-asl/kalibr/wiki/yaml-formats
#include <fmt/format.h>

#include <algorithm>

#include "incognita/io/calibrations/calibration_readers.hpp"

namespace incognita {
namespace {

std::vector<std::string> cameras_in(const YamlMap& map) {
  std::vector<std::string> cameras;
  for (const std::string& name : map.sections())
    if (map.section(name).has("camera_model") && map.section(name).has("intrinsics")) cameras.push_back(name);
  return cameras;
}

std::string kalibr_lens(CameraSettings& settings, const YamlMap& camera) {
  const std::string model = camera.word("camera_model"), lens = camera.word("distortion_model");
  if (model != "pinhole") return fmt::format("camera_model is `{}`", model);
  if (lens == "none") return set_lens(settings, false, {});
  if (lens != "radtan" && lens != "equidistant") return fmt::format("distortion_model is `{}`", lens);
  const std::vector<double> coefficients = camera.numbers("distortion_coeffs");
  if (coefficients.size() != 4)
    camera.refuse("distortion_coeffs", fmt::format("must have 4 numbers, and has {}", coefficients.size()));
  return set_lens(settings, lens == "equidistant", coefficients);
}

}  // namespace

bool is_kalibr(const YamlMap& map) { return !cameras_in(map).empty(); }

CalibrationFile read_kalibr(const YamlMap& map, const std::filesystem::path& file,
                            const CalibrationRequest& request) {
  const std::vector<std::string> cameras = cameras_in(map);
  const std::string name = request.camera.empty() ? cameras.front() : request.camera;
  if (std::find(cameras.begin(), cameras.end(), name) == cameras.end())
    map.refuse(name.c_str(),
               fmt::format("is none of the cameras of the file ({})", fmt::join(cameras, ", ")));
  CalibrationFile found{CalibrationFormat::kalibr, {file, {}, ""}, {}};
  if (cameras.size() > 1)
    found.notes.push_back(
        fmt::format("has {} cameras ({}); {} is taken", cameras.size(), fmt::join(cameras, ", "), name));
  const YamlMap camera = map.section(name);
  if (camera.has("T_cam_imu") || camera.has("T_cn_cnm1"))
    found.notes.push_back("the extrinsics are not used");
  CameraSettings& settings = found.calibrated.camera;
  found.calibrated.unfit = kalibr_lens(settings, camera);
  if (!found.calibrated.unfit.empty()) return found;
  const std::vector<double> f = camera.numbers("intrinsics");
  if (f.size() != 4)
    camera.refuse("intrinsics", fmt::format("must be fu, fv, cu, cv, and has {} numbers", f.size()));
  settings.fu_px = f[0], settings.fv_px = f[1], settings.u0_px = f[2], settings.v0_px = f[3];
  const std::vector<double> size = camera.numbers("resolution");
  if (size.size() != 2) camera.refuse("resolution", "must be width and height in px");
  set_size(settings, file, {{size[0], size[1]}}, request);
  return found;
}

}  // namespace incognita
