// Consistency of a run's filter: NIS, NEES where the truth is known, a verdict and its usual causes.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "incognita/analysis/evaluation/run_consistency.hpp"
#include "incognita/record/snapshot/snapshot.hpp"

namespace incognita {

/// Consistency of the poses of one body with the truth.
struct PoseConsistency {
  std::int64_t frames_with_truth = 0;     ///< with an estimated and a true pose
  std::int64_t overconfident_frames = 0;  ///< `tracking` with a position error above 3 sigma
  std::optional<MeanNormalizedSquare> nees;

  Consistency verdict() const { return nees ? nees->verdict() : Consistency::unknown; }
};

struct ConsistencyReport {
  Consistency verdict = Consistency::unknown;
  std::optional<MeanNormalizedSquare> nis;
  /// Share of outliers (outside the gate, or inconsistent with the other matches) among the associated
  /// measurements; their innovations are not part of NIS. Unset for fewer than ten measurements.
  std::optional<double> outlier_share;
  /// For a team, a frame counts once, whether one robot is overconfident or all; NEES is the mean over all robots.
  PoseConsistency pose;
  std::vector<PoseConsistency> bodies;
  std::string symptom;              ///< what was observed, in words; may be empty
  std::vector<std::string> causes;  ///< the usual ones, likeliest first
};

/// Above this share the model is wrong rather than the measurements: gates pass 95 % and more of the
/// measurements, and outliers in images are a few percent.
inline constexpr double highest_outlier_share = 0.2;

class ConsistencySummary {
 public:
  /// `compare`: estimate and truth are expressed in the same frame, so that NEES is meaningful.
  explicit ConsistencySummary(bool compare) : compare_(compare) {}

  void add(const Snapshot& snapshot);

  /// Means over all frames and all bodies, or of one body; NaN without any.
  double mean_nis() const { return nis_.mean(); }
  double mean_nees() const { return nees_.mean(); }
  double mean_nees(std::size_t body) const {
    return body < bodies_.size() ? bodies_[body].nees.mean() : Sum{}.mean();
  }
  ConsistencyReport report() const;

 private:
  struct Sum {
    double per_dof = 0;     ///< sum of the squares, each divided by its degrees of freedom
    double dof_in_all = 0;  ///< sum of the degrees of freedom
    std::int64_t count = 0;

    void add(double square, int dof);
    double mean() const;  ///< NaN without any
  };
  struct Body {
    Sum nees;
    int most_dof = 0;
    std::int64_t frames_with_truth = 0, overconfident_frames = 0;
  };

  void compare(const Snapshot& snapshot);

  bool compare_;
  Sum nis_;
  std::vector<double> nis_per_dof_;  ///< in time order, to see whether NIS was large from the start
  std::int64_t matches_ = 0, outliers_ = 0;
  Sum nees_;  ///< of all bodies
  std::vector<Body> bodies_;
  std::int64_t frames_with_truth_ = 0, overconfident_frames_ = 0;
};

}  // namespace incognita
