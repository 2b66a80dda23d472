#include <fmt/format.h>

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "incognita/io/formats/files.hpp"
#include "incognita/io/formats/mat_numbers.hpp"
#include "incognita/io/recordings/range_formats.hpp"
#include "incognita/io/recordings/range_recording_builder.hpp"
#include "incognita/io/recordings/reflectors.hpp"
#include "incognita/messages/errors.hpp"

namespace incognita {
namespace {

constexpr const char* data_file = "data_set.mat";
constexpr const char* beacon_file = "beac_juan3.mat";
constexpr Eigen::Index beams = 361;
constexpr double same_time_s = 1e-6;  // event and sensor array have the same time

/// Variables of a MAT file with checked dimensions.
class Variables {
 public:
  Variables(const std::filesystem::path& file, const std::vector<std::string>& names)
      : file_(file.string()), matrices_(read_mat_numbers(file, names)) {}

  std::string where(const std::string& name) const { return fmt::format("{}: `{}`", file_, name); }
  std::string where(const std::string& name, Eigen::Index row) const {
    return fmt::format("{}: `{}` {}", file_, name, row + 1);
  }

  Eigen::MatrixXd matrix(const std::string& name, Eigen::Index rows, Eigen::Index columns) const {
    const Eigen::MatrixXd& found = matrices_.at(name);
    if (found.rows() == rows && found.cols() == columns) return found;
    throw InputError(fmt::format("{}: is {}x{}, and must be {}x{}", where(name), found.rows(), found.cols(),
                                 rows, columns));
  }

  /// A nonempty row or column of finite numbers.
  Eigen::VectorXd list(const std::string& name) const {
    const Eigen::MatrixXd& found = matrices_.at(name);
    if (found.size() == 0 || (found.rows() != 1 && found.cols() != 1)) {
      throw InputError(fmt::format("{}: is {}x{}, and must be one row of numbers", where(name), found.rows(),
                                   found.cols()));
    }
    for (Eigen::Index i = 0; i < found.size(); ++i) {
      if (std::isfinite(found(i))) continue;
      throw InputError(fmt::format("{}: must be a finite number, and is {}", where(name, i), found(i)));
    }
    return found.reshaped();
  }

  /// A list with the length of another one.
  Eigen::VectorXd list(const std::string& name, const std::string& other, Eigen::Index length) const {
    Eigen::VectorXd found = list(name);
    if (found.size() == length) return found;
    throw InputError(fmt::format("{}: has {} numbers, `{}` has {}; they must be as many", where(name),
                                 found.size(), other, length));
  }

 private:
  std::string file_;
  std::map<std::string, Eigen::MatrixXd> matrices_;
};

std::vector<double> row_of(const Eigen::MatrixXd& matrix, Eigen::Index row) {
  std::vector<double> numbers(static_cast<std::size_t>(matrix.cols()));
  Eigen::VectorXd::Map(numbers.data(), matrix.cols()) = matrix.row(row);
  return numbers;
}

/// The sensor array that events of one kind refer to.
struct Sensor {
  const char* time_name;
  Eigen::VectorXd t;
  Eigen::Index last = -1;  ///< entry of the previous event
};

/// The recording as stored in the file, one array per variable.
class CarPark {
 public:
  explicit CarPark(const std::filesystem::path& file)
      : file_(file, {"Time", "Sensor", "Index", "TimeGPS", "GPSLon", "GPSLat", "Time_VS", "Velocity",
                     "Steering", "TimeLaser", "Laser", "Intensity"}),
        time_(file_.list("Time")),
        kind_(file_.list("Sensor", "Time", time_.size())),
        index_(file_.list("Index", "Time", time_.size())),
        sensors_{{"TimeGPS", file_.list("TimeGPS")},
                 {"Time_VS", file_.list("Time_VS")},
                 {"TimeLaser", file_.list("TimeLaser")}},
        east_m_(file_.list("GPSLon", "TimeGPS", sensors_[0].t.size())),
        north_m_(file_.list("GPSLat", "TimeGPS", sensors_[0].t.size())),
        speed_m_s_(file_.list("Velocity", "Time_VS", sensors_[1].t.size())),
        steering_rad_(file_.list("Steering", "Time_VS", sensors_[1].t.size())),
        range_m_(file_.matrix("Laser", sensors_[2].t.size(), beams)),
        intensity_(file_.matrix("Intensity", sensors_[2].t.size(), beams)) {}

  /// Adds all events in file order.
  void add_to(RangeRecordingBuilder& recording) {
    for (Eigen::Index event = 0; event < time_.size(); ++event) {
      const int kind = kind_of(event);
      Sensor& sensor = sensors_[kind];
      sensor.last = entry_of(event, sensor);
      add_to(recording, kind, sensor.last, time_[event]);
    }
  }

 private:
  int kind_of(Eigen::Index event) const {
    for (int kind : {0, 1, 2})
      if (kind_[event] == kind + 1) return kind;
    throw InputError(fmt::format("{}: must be 1 (GPS), 2 (wheels) or 3 (laser), and is {}",
                                 file_.where("Sensor", event), kind_[event]));
  }

  Eigen::Index entry_of(Eigen::Index event, const Sensor& sensor) const {
    const double index = index_[event];
    const std::string where = file_.where("Index", event);
    if (!(index >= 1 && index <= static_cast<double>(sensor.t.size())) || index != std::floor(index)) {
      throw InputError(fmt::format("{}: must be a whole number from 1 to {}, the length of `{}`, and is {}",
                                   where, sensor.t.size(), sensor.time_name, index));
    }
    const Eigen::Index entry = static_cast<Eigen::Index>(index) - 1;
    if (entry <= sensor.last) {
      throw InputError(
          fmt::format("{}: names entry {} of `{}` after entry {}; the events must be in time order", where,
                      entry + 1, sensor.time_name, sensor.last + 1));
    }
    if (std::abs(sensor.t[entry] - time_[event]) > same_time_s) {
      throw InputError(
          fmt::format("{}: `Time` of this event is {} s, entry {} of `{}` is of {} s; they must agree", where,
                      time_[event], entry + 1, sensor.time_name, sensor.t[entry]));
    }
    return entry;
  }

  void add_to(RangeRecordingBuilder& recording, int kind, Eigen::Index entry, double t) const {
    const std::string where = file_.where(sensors_[kind].time_name, entry);
    if (kind == 0) add_fix_reading(recording, where, {t, {east_m_[entry], north_m_[entry]}, std::nullopt});
    if (kind == 1) recording.add_odometry(where, {t, {speed_m_s_[entry], steering_rad_[entry]}});
    if (kind == 2) add_scan_reading(recording, where, entry, t);
  }

  /// A GPS fix is a measurement of the vehicle and also the best available ground truth.
  static void add_fix_reading(RangeRecordingBuilder& recording, const std::string& where,
                              const RangeRecording::TimedPosition& fix) {
    recording.add_fix(where, fix);
    recording.add_truth(where, fix);
  }

  void add_scan_reading(RangeRecordingBuilder& recording, const std::string& where, Eigen::Index entry,
                        double t) const {
    const std::vector<double> ranges = row_of(range_m_, entry), intensities = row_of(intensity_, entry);
    recording.add_scan(where, t);
    for (std::size_t beam = 0; beam < ranges.size(); ++beam) {
      if (std::isnan(intensities[beam])) {
        throw InputError(fmt::format("{}: beam {} must be a number, and is nan",
                                     file_.where("Intensity", entry), beam + 1));
      }
      if (intensities[beam] > 0 && !std::isfinite(ranges[beam]))
        recording.skip("reflective beams without a range are skipped", file_.where("Laser", entry));
    }
    for (const Detection& detection : find_reflectors(ranges, intensities))
      recording.add_detection(where, detection);
  }

  Variables file_;
  Eigen::VectorXd time_, kind_, index_;
  Sensor sensors_[3];
  Eigen::VectorXd east_m_, north_m_, speed_m_s_, steering_rad_;
  Eigen::MatrixXd range_m_, intensity_;  ///< scan by beam
};

void read_beacons(const std::filesystem::path& path, RangeRecordingBuilder& recording) {
  if (!file_exists(path)) {
    recording.note(fmt::format("there is no {}: there are no surveyed landmarks", beacon_file));
    return;
  }
  const auto read = read_mat_numbers(path, {"estbeac"});
  const Eigen::MatrixXd& beacons = read.at("estbeac");
  const std::string name = fmt::format("{}: `estbeac`", path.string());
  if (beacons.rows() == 0 || beacons.cols() != 2) {
    throw InputError(fmt::format("{}: is {}x{}, and must have two columns, east and north in m", name,
                                 beacons.rows(), beacons.cols()));
  }
  for (Eigen::Index row = 0; row < beacons.rows(); ++row) {
    const std::string where = fmt::format("{} {}", name, row + 1);
    const Eigen::Vector2d position = beacons.row(row);
    if (!position.allFinite()) throw InputError(where + ": must be two finite numbers");
    recording.add_landmark(where, {row + 1, position});
  }
}

}  // namespace

bool looks_like_acfr(const std::filesystem::path& folder) { return file_exists(folder / data_file); }

RangeRecording read_acfr(const std::filesystem::path& folder) {
  RangeRecordingBuilder recording("acfr", "ackermann");
  CarPark(folder / data_file).add_to(recording);
  read_beacons(folder / beacon_file, recording);
  recording.note("the GPS fixes serve as measurements and as truth, without heading");
  return recording.finish((folder / data_file).string());
}

}  // namespace incognita
