// The files of the bodies in a run directory.
#pragma once

#include <deque>
#include <string>
#include <vector>

#include "incognita/record/files/row_file.hpp"
#include "incognita/record/run_directory.hpp"
#include "incognita/record/snapshot/snapshot.hpp"
#include "incognita/record/summary/run_summary.hpp"

namespace incognita {

/// - vehicles.csv: a row per tick and vehicle (counted from 1): estimated pose, true pose, reference and
///   input. Headings (rad) are about z from +x, for a camera those of its optical axis.
/// - estimate-2.tum, truth-2.tum, covariance-2.csv, ...: from the second vehicle on, in the format of
///   estimate.tum, truth.tum and covariance.csv, which hold the first.
class BodyTables {
 public:
  /// Throws RecordError.
  BodyTables(const RunDirectory& directory, const RunInfo& info);

  void publish(const Snapshot& snapshot);
  void close();

 private:
  struct Poses {
    RowFile estimate, truth, covariance;
    bool truth_opened = false;
  };
  std::string vehicle_row(const Snapshot& snapshot, std::size_t vehicle) const;
  void write_poses(std::size_t vehicle, const Snapshot& snapshot);

  const RunDirectory& directory_;
  std::string body_;
  bool compare_with_truth_;  ///< estimate and truth are expressed in the same frame
  Eigen::Vector2d steered_m_;
  std::size_t inputs_;
  RowFile vehicles_;
  std::deque<Poses> others_;  ///< from the second vehicle on
};

/// "estimate-2.tum" for "estimate.tum" and the second vehicle; the first keeps the plain name.
std::string name_for_vehicle(const std::string& file, std::size_t vehicle);

}  // namespace incognita
