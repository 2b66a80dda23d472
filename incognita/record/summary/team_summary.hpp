// What summary.json says of each vehicle of a team.
#pragma once

#include <cstdint>
#include <vector>

#include "incognita/record/snapshot/snapshot.hpp"

namespace incognita {

/// True distance of the point that is steered, that much before and left of its vehicle's own, from where it
/// was to be; NaN where either is not known. A path says nothing of the height of what does not fly.
double from_path_m(const SnapshotVehicle& vehicle, bool flies, const Eigen::Vector2d& steered_m);

class TeamSummary {
 public:
  /// Each over the frames at which its own truth is known; NaN where there is nothing to say.
  struct Vehicle {
    std::int64_t compared_frames;  ///< with a pose and a truth: those that the errors are of
    double ate_m;                  ///< rms distance of estimate and truth
    double mean_nees;              ///< per degree of freedom
    double from_path_median_m,
        from_path_p95_m;  ///< true distance from where it was to be, over the last third
  };

  TeamSummary(bool flies, const Eigen::Vector2d& steered_m) : flies_(flies), steered_m_(steered_m) {}

  /// Of a snapshot with poses.
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
