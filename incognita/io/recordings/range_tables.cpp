#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

#include "incognita/io/formats/files.hpp"
#include "incognita/io/formats/named_table.hpp"
#include "incognita/io/recordings/range_formats.hpp"
#include "incognita/io/recordings/range_recording.hpp"
#include "incognita/io/recordings/range_recording_builder.hpp"
#include "incognita/math/nearest_name.hpp"
#include "incognita/messages/errors.hpp"

namespace incognita {
namespace {

constexpr const char* odometry_file = "odometry.csv";
constexpr const char* detections_file = "detections.csv";
constexpr const char* truth_file = "truth.csv";
constexpr const char* fixes_file = "fixes.csv";
constexpr const char* landmarks_file = "landmarks.csv";

struct Vehicle {
  const char* name;
  std::array<const char*, 2> inputs;  ///< columns of odometry.csv
};

constexpr Vehicle vehicles[] = {{"differential-drive", {"speed_m_s", "turn_rate_rad_s"}},
                                {"ackermann", {"wheel_speed_m_s", "steering_rad"}}};

/// Edit distance from the columns to the vehicle's inputs; 0 if they are all present.
int edits(const Vehicle& vehicle, const std::vector<std::string>& columns) {
  int sum = 0;
  for (const char* input : vehicle.inputs) sum += edit_distance(input, nearest_name(input, columns));
  return sum;
}

/// The vehicle whose columns are nearest to the header, so that a misspelled column can be reported.
const Vehicle& vehicle_of(const NamedTable& table) {
  const int drive = edits(vehicles[0], table.columns()), car = edits(vehicles[1], table.columns());
  if (drive == 0 && car == 0) {
    throw InputError(
        fmt::format("{}: has the columns of a differential drive and of an Ackermann car; remove one "
                    "vehicle's",
                    table.header()));
  }
  return vehicles[car < drive ? 1 : 0];
}

std::size_t input_column(const NamedTable& table, const char* name) {
  try {
    return table.column(name);
  } catch (const InputError& error) {
    throw InputError(fmt::format(
        "{}\nA differential drive has `{}` and `{}`, an Ackermann car `{}` and `{}`.", error.what(),
        vehicles[0].inputs[0], vehicles[0].inputs[1], vehicles[1].inputs[0], vehicles[1].inputs[1]));
  }
}

void note_unused(const NamedTable& table, std::initializer_list<std::string_view> known,
                 RangeRecordingBuilder& recording) {
  if (std::string unused = table.unused(known); !unused.empty()) recording.note(std::move(unused));
}

void read_odometry(const NamedTable& table, const Vehicle& vehicle, RangeRecordingBuilder& recording) {
  const std::size_t t = table.column("t_s"), first = input_column(table, vehicle.inputs[0]),
                    second = input_column(table, vehicle.inputs[1]);
  note_unused(table, {"t_s", vehicle.inputs[0], vehicle.inputs[1]}, recording);
  for (std::size_t row = 0; row < table.rows(); ++row) {
    recording.add_odometry(table.where(row),
                           {table.finite(row, t), {table.finite(row, first), table.finite(row, second)}});
  }
}

constexpr const char* increments[] = {"dx_m", "dy_m", "dheading_rad"};

bool has_increments(const NamedTable& table) { return table.find(increments[0]).has_value(); }

/// Columns of pose increments: how far the axle moved since the row before, in its axes there, and the covariance of that.
struct IncrementColumns {
  explicit IncrementColumns(const NamedTable& table)
      : t(table.column("t_s")),
        moved{table.column(increments[0]), table.column(increments[1]), table.column(increments[2])},
        variances{table.column("var_x_m2"), table.column("var_y_m2"), table.column("var_heading_rad2")},
        covariances{table.find("cov_xy_m2"), table.find("cov_x_heading_m_rad"),
                    table.find("cov_y_heading_m_rad")} {}

  Eigen::Vector3d increment(const NamedTable& table, std::size_t row) const {
    return {table.finite(row, moved[0]), table.finite(row, moved[1]), table.finite(row, moved[2])};
  }
  Eigen::Matrix3d covariance(const NamedTable& table, std::size_t row) const {
    Eigen::Matrix3d cov = Eigen::Matrix3d::Zero();
    for (int i = 0; i < 3; ++i) cov(i, i) = table.finite(row, variances[static_cast<std::size_t>(i)]);
    constexpr int pairs[3][2] = {{0, 1}, {0, 2}, {1, 2}};
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [i, j] = pairs[k];
      if (covariances[k]) cov(i, j) = cov(j, i) = table.finite(row, *covariances[k]);
    }
    return cov;
  }

  std::size_t t;
  std::array<std::size_t, 3> moved, variances;
  std::array<std::optional<std::size_t>, 3> covariances;
};

/// The motion between two rows is spread evenly over the time between them, so that it is a reading at the first of them.
void read_increments(const NamedTable& table, RangeRecordingBuilder& recording) {
  const IncrementColumns columns(table);
  note_unused(table,
              {"t_s", increments[0], increments[1], increments[2], "var_x_m2", "var_y_m2", "var_heading_rad2",
               "cov_xy_m2", "cov_x_heading_m_rad", "cov_y_heading_m_rad"},
              recording);
  recording.note(
      "the noise of the odometry is that of odometry.csv; vehicle.sigma_speed_m_s and vehicle.sigma_turn_rate_rad_s have no effect");
  if (table.rows() < 2)
    throw InputError(
        fmt::format("{}: must be followed by two rows at least: a row tells the motion since the row before",
                    table.header()));
  if (!columns.increment(table, 0).isZero())
    recording.note(fmt::format("{}: the increment of the first row is not used: nothing tells when it began",
                               table.where(0)));
  for (std::size_t row = 1; row < table.rows(); ++row)
    recording.add_increment(table.where(row), table.finite(row - 1, columns.t), table.finite(row, columns.t),
                            columns.increment(table, row), columns.covariance(table, row));
  const std::size_t last = table.rows() - 1;
  recording.end_increments(table.where(last), table.finite(last, columns.t));
}

void read_detections(const NamedTable& table, RangeRecordingBuilder& recording) {
  const std::size_t t = table.column("t_s"), range = table.column("range_m"),
                    bearing = table.column("bearing_rad");
  const auto identity = table.find("identity");
  note_unused(table, {"t_s", "range_m", "bearing_rad", "identity"}, recording);
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const std::string where = table.where(row);
    recording.add_scan(where, table.finite(row, t));
    const std::int64_t who = table.identity(row, identity);
    if (table.empty(row, range) && table.empty(row, bearing) && who == Detection::unknown) continue;
    if (table.empty(row, range) || table.empty(row, bearing)) {
      throw InputError(fmt::format(
          "{}: `range_m`, `bearing_rad` and `identity` must all be empty if the scan has no detection",
          where));
    }
    recording.add_detection(where, {table.number(row, range), table.number(row, bearing), who});
  }
}

/// `add` is add_truth or add_fix.
template <class Add>
void read_places(const NamedTable& table, RangeRecordingBuilder& recording, Add add) {
  const std::size_t t = table.column("t_s"), x = table.column("x_m"), y = table.column("y_m");
  const auto heading = table.find("heading_rad");
  note_unused(table, {"t_s", "x_m", "y_m", "heading_rad"}, recording);
  for (std::size_t row = 0; row < table.rows(); ++row) {
    RangeRecording::TimedPosition reading{
        table.finite(row, t), {table.finite(row, x), table.finite(row, y)}, {}};
    if (heading && !table.empty(row, *heading)) reading.heading_rad = table.finite(row, *heading);
    (recording.*add)(table.where(row), reading);
  }
}

void read_landmarks(const NamedTable& table, RangeRecordingBuilder& recording) {
  const std::size_t identity = table.column("identity"), x = table.column("x_m"), y = table.column("y_m");
  note_unused(table, {"identity", "x_m", "y_m"}, recording);
  for (std::size_t row = 0; row < table.rows(); ++row) {
    recording.add_landmark(table.where(row),
                           {table.identity(row, identity), {table.finite(row, x), table.finite(row, y)}});
  }
}

std::string identity_text(std::int64_t identity) {
  return identity == Detection::unknown ? "" : fmt::format("{}", identity);
}

std::string odometry_text(const RangeRecording& recording) {
  for (const Odometry& one : recording.odometry)
    if (one.twist)
      throw InputError(
          "odometry of pose increments is not written as tables: use the tables that it was read from");
  for (const Vehicle& vehicle : vehicles) {
    if (recording.vehicle != vehicle.name) continue;
    std::string text = fmt::format("t_s,{},{}\n", vehicle.inputs[0], vehicle.inputs[1]);
    for (const Odometry& one : recording.odometry) {
      text += fmt::format("{},{},{}\n", one.t, one.input[0], one.input[1]);
    }
    return text;
  }
  throw InputError(fmt::format("the vehicle `{}` has no odometry table; vehicles with one are `{}` and `{}`",
                               recording.vehicle, vehicles[0].name, vehicles[1].name));
}

std::string detections_text(const RangeRecording& recording) {
  std::string text = "t_s,range_m,bearing_rad,identity\n";
  for (const RangeRecording::Scan& scan : recording.scans) {
    if (scan.detections.empty()) text += fmt::format("{},,,\n", scan.t);
    for (const Detection& detection : scan.detections) {
      text += fmt::format("{},{},{},{}\n", scan.t, detection.range_m, detection.bearing_rad,
                          identity_text(detection.identity));
    }
  }
  return text;
}

std::string places_text(const std::vector<RangeRecording::TimedPosition>& places) {
  std::string text = "t_s,x_m,y_m,heading_rad\n";
  for (const RangeRecording::TimedPosition& reading : places) {
    text += fmt::format("{},{},{},{}\n", reading.t, reading.position.x(), reading.position.y(),
                        reading.heading_rad ? fmt::format("{}", *reading.heading_rad) : "");
  }
  return text;
}

std::string landmarks_text(const RangeRecording& recording) {
  std::string text = "identity,x_m,y_m\n";
  for (const RangeRecording::Landmark& landmark : recording.landmarks) {
    text += fmt::format("{},{},{}\n", identity_text(landmark.identity), landmark.position.x(),
                        landmark.position.y());
  }
  return text;
}

void write_text(const std::filesystem::path& file, const std::string& text) {
  errno = 0;
  std::ofstream out(file, std::ios::binary);
  out << text;
  out.close();
  if (out) return;
  throw RecordError(fmt::format("cannot write {}: {}; free some space or choose another folder",
                                file.string(), std::strerror(errno != 0 ? errno : EIO)));
}

/// Tables left by another recording would be read as part of this one.
void refuse_tables_in(const std::filesystem::path& folder) {
  for (const char* name : {odometry_file, detections_file, truth_file, fixes_file, landmarks_file}) {
    std::error_code ignored;
    if (!std::filesystem::exists(folder / name, ignored)) continue;
    throw RecordError(fmt::format("{} is already there; choose another folder, or remove it first",
                                  (folder / name).string()));
  }
}

}  // namespace

bool looks_like_range_tables(const std::filesystem::path& folder) {
  return file_exists(folder / odometry_file) || file_exists(folder / detections_file);
}

RangeRecording read_range_tables(const std::filesystem::path& folder) {
  const NamedTable odometry(folder / odometry_file);
  const bool moves = has_increments(odometry);
  const Vehicle& vehicle = moves ? vehicles[0] : vehicle_of(odometry);
  RangeRecordingBuilder recording("tables", vehicle.name);
  if (moves)
    read_increments(odometry, recording);
  else
    read_odometry(odometry, vehicle, recording);
  read_detections(NamedTable(folder / detections_file), recording);
  if (file_exists(folder / truth_file)) {
    read_places(NamedTable(folder / truth_file), recording, &RangeRecordingBuilder::add_truth);
  } else {
    recording.note("there is no truth.csv: the truth is unknown");
  }
  if (file_exists(folder / fixes_file)) {
    read_places(NamedTable(folder / fixes_file), recording, &RangeRecordingBuilder::add_fix);
  }
  if (file_exists(folder / landmarks_file)) {
    read_landmarks(NamedTable(folder / landmarks_file), recording);
  } else {
    recording.note("there is no landmarks.csv: there are no surveyed landmarks");
  }
  return recording.finish(folder.string());
}

void write_range_tables(const RangeRecording& recording, const std::filesystem::path& folder) {
  const std::string odometry = odometry_text(recording);
  refuse_tables_in(folder);
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw RecordError(fmt::format("cannot create {}: {}", folder.string(), error.message()));
  write_text(folder / odometry_file, odometry);
  write_text(folder / detections_file, detections_text(recording));
  if (!recording.truth.empty()) write_text(folder / truth_file, places_text(recording.truth));
  if (!recording.fixes.empty()) write_text(folder / fixes_file, places_text(recording.fixes));
  if (!recording.landmarks.empty()) write_text(folder / landmarks_file, landmarks_text(recording));
}

}  // namespace incognita
