#include "incognita/io/recordings/euroc_camera.hpp"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <Eigen/LU>
#include <cmath>
#include <vector>

#include "incognita/io/formats/files.hpp"
#include "incognita/messages/errors.hpp"

namespace incognita {
namespace {

constexpr std::size_t largest_file = 1 << 20;

class SensorFile {
 public:
  explicit SensorFile(const std::filesystem::path& file) : file_(file) {
    std::string text = read_file(file, largest_file);
    if (text.starts_with("%YAML:")) text[0] = '#';  // OpenCV's first line is not a valid YAML directive
    try {
      root_ = YAML::Load(text);
    } catch (const YAML::Exception& error) {
      refuse(error.mark, fmt::format("is not YAML: {}", error.msg));
    }
    if (!root_.IsMap()) refuse(root_.Mark(), "must be a list of `key: value`");
  }

  bool has(const char* key) const { return root_[key].IsDefined(); }
  std::string word(const char* key) const {
    return has(key) && root_[key].IsScalar() ? root_[key].Scalar() : "";
  }
  std::vector<double> numbers(const char* key) const { return numbers(key, root_[key]); }

  /// A matrix in the notation of OpenCV and EuRoC: `rows`, `cols`, `data`.
  std::vector<double> matrix(const char* key) const {
    const YAML::Node node = root_[key];
    return node.IsDefined() && node.IsMap() ? numbers(key, node["data"]) : numbers(key, node);
  }

  [[noreturn]] void refuse(const char* key, const std::string& why) const {
    refuse(has(key) ? root_[key].Mark() : YAML::Mark::null_mark(), fmt::format("{} {}", key, why));
  }

 private:
  std::vector<double> numbers(const char* key, const YAML::Node& node) const {
    std::vector<double> found;
    if (!node.IsDefined() || !node.IsSequence()) refuse(key, "must be a list of numbers, written [1, 2, 3]");
    for (const YAML::Node& entry : node) {
      double number = 0;
      if (!YAML::convert<double>::decode(entry, number) || !std::isfinite(number))
        refuse(entry.Mark(), fmt::format("{} must hold numbers only, and has `{}`", key,
                                         entry.IsScalar() ? entry.Scalar().substr(0, 60) : "a list"));
      found.push_back(number);
    }
    return found;
  }

  [[noreturn]] void refuse(const YAML::Mark& mark, const std::string& why) const {
    throw InputError(mark.is_null() ? fmt::format("{}: {}", shown(file_), why)
                                    : fmt::format("{}:{}: {}", shown(file_), mark.line + 1, why));
  }

  std::filesystem::path file_;
  YAML::Node root_;
};

std::optional<Eigen::Matrix4d> body_from_camera(const SensorFile& file) {
  if (!file.has("T_BS")) return std::nullopt;
  const std::vector<double> numbers = file.matrix("T_BS");
  if (numbers.size() != 16)
    file.refuse("T_BS", fmt::format("must have 16 numbers, and has {}", numbers.size()));
  const Eigen::Matrix4d m = Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(numbers.data());
  const Eigen::Matrix3d r = m.topLeftCorner<3, 3>();
  const bool rotates = (r * r.transpose() - Eigen::Matrix3d::Identity()).norm() < 1e-3 && r.determinant() > 0;
  if (!rotates)
    file.refuse("T_BS", "must be a rigid transformation, but its upper left 3x3 is not a rotation");
  return m;
}

/// Whether the distortion is that of the `fisheye` model, by the words of Kalibr and of OpenCV.
bool is_fisheye(const SensorFile& file) {
  const std::string lens = file.word("distortion_model");
  return lens == "equidistant" || lens == "fisheye";
}

/// The `pinhole` model has OpenCV's coefficient order k1 k2 p1 p2 k3; EuRoC has the same without k3. The `fisheye` model has
/// k1 k2 k3 k4, as Kalibr and OpenCV.
decltype(CameraSettings::model) lens_of(const SensorFile& file, const std::vector<double>& k) {
  PinholeLens pinhole;
  FisheyeLens fisheye;
  double* const of_pinhole[] = {&pinhole.k1, &pinhole.k2, &pinhole.p1, &pinhole.p2, &pinhole.k3};
  double* const of_fisheye[] = {&fisheye.k1, &fisheye.k2, &fisheye.k3, &fisheye.k4};
  for (std::size_t i = 0; i < k.size(); ++i) *(is_fisheye(file) ? of_fisheye : of_pinhole)[i] = k[i];
  if (is_fisheye(file)) return fisheye;
  return pinhole;
}

std::string why_unfit(const SensorFile& file, const std::vector<double>& distortion) {
  const std::string model = file.word("camera_model"), lens = file.word("distortion_model");
  const bool radial_tangential = lens == "radial-tangential" || lens == "radtan" || lens == "plumb_bob" ||
                                 lens == "none" || lens.empty();
  if (model != "pinhole") return fmt::format("camera_model is `{}`", model);
  if (!radial_tangential && !is_fisheye(file)) return fmt::format("distortion_model is `{}`", lens);
  if (distortion.size() > (is_fisheye(file) ? 4 : 5))
    return fmt::format("there are {} distortion_coefficients", distortion.size());
  return "";
}

std::optional<CalibratedCamera> camera_of(const SensorFile& file, const std::filesystem::path& path) {
  if (!file.has("intrinsics")) return std::nullopt;
  CalibratedCamera found{path, {}, ""};
  const std::vector<double> distortion =
      file.has("distortion_coefficients") ? file.matrix("distortion_coefficients") : std::vector<double>{};
  found.unfit = why_unfit(file, distortion);
  if (!found.unfit.empty()) return found;
  const std::vector<double> f = file.numbers("intrinsics"), size = file.numbers("resolution");
  if (f.size() != 4)
    file.refuse("intrinsics", fmt::format("must be fu, fv, cu, cv, and has {} numbers", f.size()));
  if (size.size() != 2 || !(size[0] >= 1 && size[0] <= 1e5 && size[1] >= 1 && size[1] <= 1e5))
    file.refuse("resolution", "must be width and height in px");
  CameraSettings& camera = found.camera;
  camera.model = lens_of(file, distortion);
  camera.width_px = static_cast<int>(size[0]), camera.height_px = static_cast<int>(size[1]);
  camera.fu_px = f[0], camera.fv_px = f[1], camera.u0_px = f[2], camera.v0_px = f[3];
  return found;
}

}  // namespace

EurocSensor read_euroc_sensor(const std::filesystem::path& path) {
  const SensorFile file(path);
  return {camera_of(file, path), body_from_camera(file)};
}

}  // namespace incognita
