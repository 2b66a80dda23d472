#include "incognita/io/calibrations/calibration_readers.hpp"

#include <fmt/format.h>

#include <cmath>

#include "incognita/io/formats/files.hpp"
#include "incognita/messages/errors.hpp"

namespace incognita {

void check_size(const CameraSettings& camera, const std::filesystem::path& file,
                const CalibrationRequest& request) {
  const auto& wanted = request.image_size_px;
  if (wanted && (wanted->first != camera.width_px || wanted->second != camera.height_px))
    throw InputError(fmt::format("{}: is for images of {}x{} px, and --image-size is {}x{}", shown(file),
                                 camera.width_px, camera.height_px, wanted->first, wanted->second));
}

void set_size(CameraSettings& camera, const std::filesystem::path& file,
              std::optional<std::pair<double, double>> in_file, const CalibrationRequest& request) {
  if (!in_file && !request.image_size_px)
    throw InputError(fmt::format("{}: has no image size, without which a camera is not complete: {}",
                                 shown(file), request.size_remedy));
  const std::pair<double, double> size =
      in_file ? *in_file : std::pair<double, double>(*request.image_size_px);
  const auto valid = [](double side) { return side >= 1 && side <= 1e5 && side == std::floor(side); };
  if (!valid(size.first) || !valid(size.second))
    throw InputError(fmt::format("{}: the image is {}x{} px, and must be of whole pixels, 1 to 1e5",
                                 shown(file), size.first, size.second));
  camera.width_px = static_cast<int>(size.first), camera.height_px = static_cast<int>(size.second);
  check_size(camera, file, request);
}

std::string set_lens(CameraSettings& camera, bool fisheye, const std::vector<double>& coefficients) {
  PinholeLens pinhole;
  FisheyeLens round;
  double* const of_pinhole[] = {&pinhole.k1, &pinhole.k2, &pinhole.p1, &pinhole.p2, &pinhole.k3};
  double* const of_fisheye[] = {&round.k1, &round.k2, &round.k3, &round.k4};
  const std::size_t held = fisheye ? 4 : 5;
  for (std::size_t i = 0; i < coefficients.size(); ++i) {
    if (i >= held && coefficients[i] != 0)
      return fmt::format("there are {} distortion coefficients, and those beyond the first {} are not 0",
                         coefficients.size(), held);
    if (i < held) *(fisheye ? of_fisheye : of_pinhole)[i] = coefficients[i];
  }
  if (fisheye)
    camera.model = round;
  else
    camera.model = pinhole;
  return "";
}

std::string set_matrix(CameraSettings& camera, const std::vector<double>& m) {
  if (m.size() != 9) return fmt::format("must have 9 numbers, and has {}", m.size());
  if (m[3] != 0 || m[6] != 0 || m[7] != 0 || m[8] != 1) return "must be fx 0 cx, 0 fy cy, 0 0 1, row by row";
  if (std::abs(m[1]) > 1e-9) return fmt::format("has a skew of {}", m[1]);
  camera.fu_px = m[0], camera.fv_px = m[4], camera.u0_px = m[2], camera.v0_px = m[5];
  return "";
}

}  // namespace incognita
