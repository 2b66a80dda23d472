#include <fmt/format.h>

#include <Eigen/LU>
#include <charconv>
#include <optional>

#include "incognita/io/files.hpp"
#include "incognita/io/number_table.hpp"
#include "incognita/io/recording_formats.hpp"
#include "incognita/math/quaternion.hpp"
#include "incognita/messages/errors.hpp"

namespace incognita {
namespace {

constexpr const char* truth_file = "state_groundtruth_estimate0/data.csv";

std::filesystem::path mav_folder(const std::filesystem::path& folder) {
  return file_exists(folder / "cam0/data.csv") ? folder : folder / "mav0";
}

/// Whole nanoseconds since 1970 need 61 bits, more than a double has: split before converting.
double seconds(const TableLine& line) {
  const std::string& cell = line.text(0);
  std::int64_t ns = 0;
  const char* end = cell.data() + cell.size();
  const auto [stopped, error] = std::from_chars(cell.data(), end, ns);
  if (error != std::errc() || stopped != end) {
    throw InputError(
        fmt::format("{}: column 1 must be a stamp in whole nanoseconds, and is `{}`", line.where, cell));
  }
  return static_cast<double>(ns / 1'000'000'000) + static_cast<double>(ns % 1'000'000'000) * 1e-9;
}

/// The sixteen numbers of `T_BS: data: [...]`, row by row: body_from_camera.
std::optional<Eigen::Matrix4d> body_from_camera(const std::filesystem::path& file) {
  if (!file_exists(file)) return std::nullopt;
  const std::string yaml = read_file(file, 1 << 20);
  std::size_t at = yaml.find("T_BS:");
  at = at == std::string::npos ? at : yaml.find('[', at);
  if (at == std::string::npos) return std::nullopt;
  Eigen::Matrix4d m;
  for (int i = 0; i < 16; ++i) {
    at = yaml.find_first_not_of("[, \t\r\n", at);
    if (at == std::string::npos) return std::nullopt;
    const auto [stopped, error] =
        std::from_chars(yaml.data() + at, yaml.data() + yaml.size(), m(i / 4, i % 4));
    if (error != std::errc()) return std::nullopt;
    at = static_cast<std::size_t>(stopped - yaml.data());
  }
  const Eigen::Matrix3d r = m.topLeftCorner<3, 3>();
  const bool rotates = (r * r.transpose() - Eigen::Matrix3d::Identity()).norm() < 1e-3 && r.determinant() > 0;
  return rotates ? std::optional(m) : std::nullopt;
}

void read_truth(const std::filesystem::path& mav, Recording& recording) {
  const std::optional<Eigen::Matrix4d> body = body_from_camera(mav / "cam0/sensor.yaml");
  recording.notes.push_back(
      body ? "the truth is made the camera's with T_BS of cam0/sensor.yaml"
           : "the truth is the body's, not the camera's: there is no T_BS in cam0/sensor.yaml");
  const Eigen::Vector3d offset =
      body ? Eigen::Vector3d(body->topRightCorner<3, 1>()) : Eigen::Vector3d::Zero();
  const Eigen::Vector4d turn =
      body ? quaternion_from_matrix(body->topLeftCorner<3, 3>()) : Eigen::Vector4d(1, 0, 0, 0);
  for (const TableLine& line : read_table(mav / truth_file)) {
    const Eigen::Vector4d q(line.number(4), line.number(5), line.number(6), line.number(7));
    if (std::abs(q.norm() - 1) > 1e-2) {
      throw InputError(fmt::format("{}: columns 5 to 8 must be a unit quaternion, their norm is {}",
                                   line.where, q.norm()));
    }
    const double t = seconds(line);
    if (!recording.truth.empty() && t < recording.truth.back().t) {
      throw InputError(fmt::format("{}: the stamps must not decrease, {} does", line.where, line.text(0)));
    }
    const Eigen::Vector4d world_from_body = q.normalized();
    const Eigen::Vector3d position(line.number(1), line.number(2), line.number(3));
    recording.truth.push_back({t, position + rotation_matrix(world_from_body) * offset,
                               quaternion_product(world_from_body, turn).normalized()});
  }
}

}  // namespace

bool looks_like_euroc(const std::filesystem::path& folder) {
  return file_exists(mav_folder(folder) / "cam0/data.csv");
}

Recording read_euroc(const std::filesystem::path& folder) {
  const std::filesystem::path mav = mav_folder(folder);
  Recording recording{"euroc", folder, {}, {}, {}};
  for (const TableLine& line : read_table(mav / "cam0/data.csv")) {
    const double t = seconds(line);
    if (!recording.frames.empty() && t <= recording.frames.back().t) {
      throw InputError(fmt::format("{}: the stamps must increase, {} does not", line.where, line.text(0)));
    }
    recording.frames.push_back({t, mav / "cam0/data" / line.text(1)});
  }
  if (recording.frames.empty())
    throw InputError(fmt::format("{}: lists no images", (mav / "cam0/data.csv").string()));
  if (file_exists(mav / truth_file)) {
    read_truth(mav, recording);
  } else {
    recording.notes.push_back(fmt::format("there is no {}: the truth is unknown", truth_file));
  }
  return recording;
}

}  // namespace incognita
