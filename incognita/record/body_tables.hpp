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

/// - vehicles.csv: a row per tick and vehicle (counted from 1): state, estimated pose, true pose, reference and
///   input. Headings (rad) are about z from +x, for a camera those of its optical axis.
/// - estimate-2.tum, truth-2.tum, covariance-2.csv, ...: from the second vehicle on, in the format of
///   estimate.tum, truth.tum and covariance.csv, which hold the first.
/// - actions.csv, actions-2.csv, ...: a row per decision of the body: time, chosen action, score of each candidate.
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
  struct Actions {
    RowFile file;
    std::size_t candidates = 0;  ///< columns after t and chosen
    bool opened = false;         ///< since the first decision; actions.csv exists without one, too
  };
  std::string vehicle_row(const Snapshot& snapshot, std::size_t vehicle) const;
  void write_poses(std::size_t vehicle, const Snapshot& snapshot);
  void open(Actions& actions, std::size_t vehicle, const std::vector<std::string>& names);
  void write_decision(std::size_t vehicle, const Snapshot& snapshot);

  const RunDirectory& directory_;
  std::string body_;
  bool compare_with_truth_;  ///< estimate and truth are expressed in the same frame
  Eigen::Vector2d steered_m_;
  std::size_t inputs_;
  RowFile vehicles_;
  std::deque<Poses> others_;  ///< from the second vehicle on
  std::deque<Actions> actions_;
};

/// "estimate-2.tum" for "estimate.tum" and the second vehicle; the first keeps the plain name.
std::string name_for_vehicle(const std::string& file, std::size_t vehicle);

}  // namespace incognita
