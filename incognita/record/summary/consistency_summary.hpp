// Whether a run's filter was as far off as it said: NIS always, NEES where the truth is known, a verdict, and
// what usually causes it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "incognita/analysis/evaluation/run_consistency.hpp"
#include "incognita/record/snapshot/snapshot.hpp"

namespace incognita {

/// Of one body's poses against the truth.
struct PoseConsistency {
  std::int64_t frames_with_truth = 0;     ///< with an estimated and a true pose
  std::int64_t overconfident_frames = 0;  ///< of these: `tracking`, and beyond 3 sigma of the true position
  std::optional<MeanNormalizedSquare> nees;

  Consistency verdict() const { return nees ? nees->verdict() : Consistency::unknown; }
};

struct ConsistencyReport {
  Consistency verdict = Consistency::unknown;
  std::optional<MeanNormalizedSquare> nis;
  /// Share of the measurements with a landmark to compare them with that are outside its gate, or contradict
  /// the other matches. The innovations of these are not part of NIS. Nothing for fewer than ten.
  std::optional<double> outlier_share;
  /// Of a team: a frame counts once, whether one robot is overconfident or all; NEES is the mean over all
  /// robots.
  PoseConsistency pose;
  std::vector<PoseConsistency> robots;  ///< of a team
  std::string symptom;                  ///< what was seen, in words; may be empty
  std::vector<std::string> causes;      ///< the usual ones, the likeliest first
};

/// Beyond this share the model is wrong, not the measurements: gates let through 95 % and more, and false
/// matches in images are some percent.
inline constexpr double highest_outlier_share = 0.2;

class ConsistencySummary {
 public:
  /// `compare`: whether estimate and truth are in one frame, so that a covariance speaks of their difference.
  explicit ConsistencySummary(bool compare) : compare_(compare) {}

  void add(const Snapshot& snapshot);

  /// Over all frames, and of a team over all robots; NaN without any.
  double mean_nis() const { return nis_.mean(); }
  double mean_nees() const { return nees_.mean(); }
  ConsistencyReport report() const;

 private:
  struct Sum {
    double per_dof = 0;     ///< of the squares, each over its degrees of freedom
    double dof_in_all = 0;  ///< of all together
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
  std::vector<double> nis_per_dof_;  ///< in order of time: whether it was large from the start
  std::int64_t matches_ = 0, outliers_ = 0;
  Sum nees_;                  ///< of all bodies
  std::vector<Body> bodies_;  ///< one, or the robots of a team
  std::int64_t frames_with_truth_ = 0, overconfident_frames_ = 0;
};

}  // namespace incognita
