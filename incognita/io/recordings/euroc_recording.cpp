#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "incognita/io/formats/files.hpp"
#include "incognita/io/formats/number_table.hpp"
#include "incognita/io/recordings/recording_formats.hpp"
#include "incognita/math/quaternion.hpp"
#include "incognita/math/time_stamp.hpp"
#include "incognita/messages/errors.hpp"

namespace incognita {
namespace {

constexpr const char* truth_file = "state_groundtruth_estimate0/data.csv";
constexpr const char* sensor_file = "cam0/sensor.yaml";

std::filesystem::path mav_folder(const std::filesystem::path& folder) {
  return file_exists(folder / "cam0/data.csv") ? folder : folder / "mav0";
}

EurocSensor sensor_in(const std::filesystem::path& mav) {
  return file_exists(mav / sensor_file) ? read_euroc_sensor(mav / sensor_file) : EurocSensor{};
}

double seconds(const TableLine& line) {
  const std::string& cell = line.text(0);
  if (const auto t = seconds_from_nanoseconds(cell)) return *t;
  throw InputError(
      fmt::format("{}: column 1 must be a stamp in whole nanoseconds, and is `{}`", line.where, cell));
}

void read_truth(const std::filesystem::path& mav, const std::optional<Eigen::Matrix4d>& body,
                Recording& recording) {
  recording.notes.push_back(
      body ? "the truth is transformed to the camera with T_BS of cam0/sensor.yaml"
           : "the truth is that of the body, not of the camera: there is no T_BS in cam0/sensor.yaml");
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

void note_camera(const EurocSensor& sensor, Recording& recording) {
  recording.camera = sensor.camera;
  if (!sensor.camera)
    recording.notes.push_back(fmt::format("no intrinsics in {}: the camera is not compared", sensor_file));
  else if (!sensor.camera->unfit.empty())
    recording.notes.push_back(
        fmt::format("{}: {}, which no camera model supports: the camera is not compared", sensor_file,
                    sensor.camera->unfit));
}

}  // namespace

bool looks_like_euroc(const std::filesystem::path& folder) {
  return file_exists(mav_folder(folder) / "cam0/data.csv");
}

std::optional<CalibratedCamera> camera_in_euroc(const std::filesystem::path& folder) {
  return sensor_in(mav_folder(folder)).camera;
}

Recording read_euroc(const std::filesystem::path& folder) {
  const std::filesystem::path mav = mav_folder(folder);
  Recording recording{"euroc", folder, {}, {}, {}, {}};
  for (const TableLine& line : read_table(mav / "cam0/data.csv")) {
    const double t = seconds(line);
    if (!recording.frames.empty() && t <= recording.frames.back().t) {
      throw InputError(fmt::format("{}: the stamps must increase, {} does not", line.where, line.text(0)));
    }
    recording.frames.push_back({t, mav / "cam0/data" / line.text(1)});
  }
  if (recording.frames.empty())
    throw InputError(fmt::format("{}: lists no images", (mav / "cam0/data.csv").string()));
  const EurocSensor sensor = sensor_in(mav);
  note_camera(sensor, recording);
  if (file_exists(mav / truth_file)) {
    read_truth(mav, sensor.body_from_camera, recording);
  } else {
    recording.notes.push_back(fmt::format("there is no {}: the truth is unknown", truth_file));
  }
  return recording;
}

}  // namespace incognita
