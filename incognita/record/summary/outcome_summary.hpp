// Outcome of a run: how much of the world is mapped and how well, and whether the estimate is where it should be.
//
// Everything here is against the truth of a simulation, in the frame of the estimate without alignment: the frame must be that of
// the truth (a rendered world with a start target, anchors, position fixes).
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "incognita/record/snapshot/snapshot.hpp"

namespace incognita {

/// Nothing where the truth is not known.
struct OutcomeMeasures {
  /// Share of the world mapped to 5 cm at the end: analysis/evaluation/mapped_share.hpp; of the rendered room of its textured
  /// surface: world/rendered/surface_patches.hpp.
  std::optional<double> mapped;
  std::optional<double> mapped_60_s;  ///< after 60 s; nothing in a shorter run
  std::optional<double>
      t_90_mapped_s;  ///< when 90 % was mapped for the first time, s; nothing if it never was

  // Over the landmarks in the map at the end whose true position is known, without anchors; nothing without any.
  int landmarks = 0;                  ///< their number
  std::optional<double> map_rms_m;    ///< rms distance from the true position
  std::optional<double> within_5_cm;  ///< share that is within mapped_within_m of it
  /// Share whose true position is within the 3-sigma ellipsoid: e' P^-1 e of the error e and the landmark's covariance P is at most
  /// the 0.9973 quantile of chi-square with 3 degrees of freedom, 14.156; on a plane with 2, 11.829. beyond_three_sigma()
  std::optional<double> within_3_sigma;

  /// rms over all poses, of all bodies, whose true position is known; nothing without any.
  std::optional<double> position_rms_m;
  bool lost = false;  ///< at the end
  /// Lost at the end, or position_rms_m above diverged_m, or not one pose to compare.
  std::optional<bool> diverged;
};

class OutcomeSummary {
 public:
  static constexpr double diverged_m = 0.5;

  /// `same_frame`: as the truth, run_info.hpp.
  explicit OutcomeSummary(bool same_frame) : same_frame_(same_frame) {}

  void add(const Snapshot& snapshot);

  OutcomeMeasures measures() const;

 private:
  void add_poses(const Snapshot& snapshot);
  void add_mapped(const Snapshot& snapshot);
  void put_map(OutcomeMeasures& measures) const;

  bool same_frame_;
  bool lost_ = false;
  double squares_m2_ = 0;
  std::int64_t poses_ = 0;
  bool knows_truth_ = false;
  bool was_early_ = false, had_few_ = false;  ///< at some frame: before 60 s, with less than 90 % mapped
  std::optional<double> mapped_, mapped_60_s_, t_90_mapped_s_;
  std::vector<SnapshotLandmark> map_;  ///< of the last snapshot
};

}  // namespace incognita
