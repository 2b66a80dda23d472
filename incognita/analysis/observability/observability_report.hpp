// What a filter can know of its world's frame and scale, what it has learnt, and what it only believes: a
// monitor's information held against the symmetries of the sensor.
//
// "Can" is what remains of the symmetries after the anchors and position fixes seen so far. "Has learnt" is
// the marginal information of a quantity, everything else unknown and no prior: looks, motions and their
// assumed noise at the filter's own Jacobians. A quantity that cannot be known, and of which the filter's
// looks alone have told it something, is one that it wrongly believes to know: what looks see is left alone
// by the symmetries, motions or not. Of a camera, motions tell more: accelerations have a size, whether they
// are commanded (v' = v + a dt does not scale with v) or only assumed. What is known by them alone is no
// mistake of the looks.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "incognita/analysis/observability/symmetries.hpp"

namespace incognita {

/// What a monitor has: ObservabilityMonitor::information() and gathered().
struct MonitoredInformation {
  Eigen::MatrixXd Y;
  Eigen::VectorXd gathered;
};

/// A rank of an information matrix, told in units that make 1 as good as nothing, and how clear it is.
struct InformationRank {
  int errors = 0;
  int rank = 0;
  double tolerance = 0;         ///< eigenvalues above it count; what rounding could leave
  double least_counted = 0;     ///< 0 without any
  double most_not_counted = 0;  ///< 0 without any
  bool ambiguous =
      false;  ///< an eigenvalue is within a factor of 30 of the tolerance, or that is not far below 1

  int nullity() const { return errors - rank; }
  /// Least counted over most not counted, which is at least the tolerance of rounding's own.
  double gap() const;
};
/// `units`: by error, the size that is as good as not knowing it.
InformationRank rank_of_information(const MonitoredInformation& information, const Eigen::VectorXd& units);

/// What has fixed the frame so far.
struct FixedPoints {
  Eigen::MatrixXd
      positions;  ///< dimension x number: anchors that corrected the filter, places of position fixes
  int anchors = 0;
  bool position_fixes = false;
};

struct QuantityReport {
  std::string name;  ///< `x`, `y`, `heading`; `x`, `y`, `z`, `turn about x`, ..., `scale`
  std::string unit;  ///< `m`, `rad`, or `1` for the scale, a ratio
  bool ideally_observable = false;
  /// Standard deviation that the filter's own information leaves, without prior; none where it has none
  std::optional<double> estimated_sigma;
  bool gained = false;  ///< that sigma says something: it is less than the scene, a radian, a hundred percent
  bool by_motion_model = false;  ///< it says something, and what the looks alone leave does not
  std::optional<double> sigma_from_measurements;  ///< the same of looks alone, where they are told apart
};

struct ObservabilityReport {
  std::string uncovered;  ///< why the filter's information is not followed; empty where it is
  int anchors = 0;        ///< that corrected the filter
  bool position_fixes = false;
  int ideal_nullity = 0;  ///< symmetries that remain
  // Of the filter's information; 0 and empty where it is not followed
  InformationRank information;
  int spurious_information = 0;  ///< of the remaining symmetries, along how many looks have told the filter
  int by_motion_model = 0;       ///< and along how many more it knows by its motion model
  std::vector<QuantityReport> quantities;
  std::vector<std::string> without_information;  ///< what could be known, and of which nothing was learnt
};

/// What the filter has by all that was done, ordered as the scene says; empty where it is not followed, then
/// `uncovered` says why. Where motions carry the symmetries on whatever they are, as odometry does, all that
/// was gained of them is the looks'.
ObservabilityReport observability_report(const MonitoredInformation& of_filter, const PlanarScene& scene,
                                         const FixedPoints& fixed, const std::string& uncovered = "");
/// `of_measurements`: by looks alone, motions telling nothing; not asked for, and may be empty, where no symmetry
/// remains.
ObservabilityReport observability_report(const MonitoredInformation& of_filter,
                                         const MonitoredInformation& of_measurements,
                                         const SpatialScene& scene, const FixedPoints& fixed,
                                         const std::string& uncovered = "");

/// The same for a person, a sentence each: "scale: fixed by 4 anchors".
std::vector<std::string> in_words(const ObservabilityReport& report);

}  // namespace incognita
