// Summary of each vehicle of a team.
#pragma once

#include <cstdint>
#include <vector>

#include "incognita/record/snapshot/snapshot.hpp"

namespace incognita {

/// True distance between the controlled point (`steered_m`: ahead and left of the vehicle's origin) and its
/// reference; NaN if either is unknown. Planar unless the vehicle flies, since the paths of ground vehicles
/// have no height.
double from_path_m(const SnapshotVehicle& vehicle, bool flies, const Eigen::Vector2d& steered_m);

class TeamSummary {
 public:
  /// Means over the frames in which the vehicle's truth is known; NaN if there are none.
  struct Vehicle {
    std::int64_t compared_frames;                ///< with a valid pose and truth
    double ate_m;                                ///< rms distance of estimate and truth
    double mean_nees;                            ///< per degree of freedom
    double from_path_median_m, from_path_p95_m;  ///< true distance from the reference, last third of the run
  };

  TeamSummary(bool flies, const Eigen::Vector2d& steered_m) : flies_(flies), steered_m_(steered_m) {}

  /// Adds a snapshot with valid poses.
  void add(const Snapshot& snapshot);

  bool empty() const { return vehicles_.empty(); }
  std::vector<Vehicle> vehicles() const;

 private:
  struct Sums {
    double squares = 0, nees = 0;
    std::int64_t compared = 0, nees_count = 0;
    std::vector<double> from_path_m;
  };
  bool flies_;
  Eigen::Vector2d steered_m_;
  std::vector<Sums> vehicles_;
};

}  // namespace incognita
