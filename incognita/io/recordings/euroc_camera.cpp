#include "incognita/io/recordings/euroc_camera.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <vector>

#include "incognita/io/calibrations/euroc_sensor.hpp"
#include "incognita/io/calibrations/yaml_map.hpp"
#include "incognita/io/formats/files.hpp"

namespace incognita {
namespace {

constexpr std::size_t largest_file = 1 << 20;

std::optional<Eigen::Matrix4d> body_from_camera(const YamlMap& file) {
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

}  // namespace

EurocSensor read_euroc_sensor(const std::filesystem::path& path) {
  const YamlMap file(path, read_file(path, largest_file));
  EurocSensor sensor{std::nullopt, body_from_camera(file)};
  if (file.has("intrinsics")) sensor.camera = camera_in_euroc_sensor(file, path);
  return sensor;
}

}  // namespace incognita
