// Observability of the world frame and scale in a running filter: the monitored information compared with the
// symmetries of the sensor.
//
// A quantity is ideally observable unless a symmetry that remains after the anchors and position fixes so far changes
// it. Its information is marginal, with everything else unknown and without prior: measurements, motions and their
// assumed noise at the filter's own Jacobians. Information of the measurements alone about an unobservable quantity
// is spurious, since measurements are invariant under the symmetries, whatever the motions. For a camera, motions add
// information: accelerations have a scale, whether commanded (v' = v + a dt does not scale with v) or only assumed.
// What is constrained only by the motion model is therefore not spurious.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "incognita/analysis/observability/symmetries.hpp"

namespace incognita {

/// Output of a monitor: ObservabilityMonitor::information() and gathered().
struct MonitoredInformation {
  Eigen::MatrixXd Y;
  Eigen::VectorXd gathered;
};

/// Rank of an information matrix in units in which 1 is insignificant, and how clear it is.
struct InformationRank {
  int errors = 0;
  int rank = 0;
  double tolerance = 0;         ///< eigenvalues above it count; bound of the rounding error
  double least_counted = 0;     ///< smallest counted eigenvalue; 0 without any
  double most_not_counted = 0;  ///< largest uncounted eigenvalue; 0 without any
  /// An eigenvalue is within a factor of 30 of the tolerance, or that is not far below 1.
  bool ambiguous = false;

  int nullity() const { return errors - rank; }
  /// Smallest counted over largest uncounted eigenvalue, the latter at least the tolerance of the rounding alone.
  double gap() const;
};
/// `units`: per error, the standard deviation that counts as no information.
InformationRank rank_of_information(const MonitoredInformation& information, const Eigen::VectorXd& units);

/// What has fixed the frame so far.
struct FixedPoints {
  Eigen::MatrixXd positions;  ///< dimension x number: anchors that corrected the filter, positions of fixes
  int anchors = 0;
  bool position_fixes = false;
};

struct QuantityReport {
  std::string name;  ///< `x`, `y`, `heading`; `x`, `y`, `z`, `rotation about x`, ..., `scale`
  std::string unit;  ///< `m`, `rad`, or `1` for the scale, a ratio
  bool ideally_observable = false;
  /// Standard deviation from the filter's own information, without prior; empty without information
  std::optional<double> estimated_sigma;
  bool gained = false;  ///< that sigma is significant: less than the scene, a radian, a hundred percent
  bool by_motion_model = false;                   ///< significant, but not from the measurements alone
  std::optional<double> sigma_from_measurements;  ///< estimated_sigma from measurements alone, if computed
};

struct ObservabilityReport {
  std::string uncovered;  ///< why the monitor stopped; empty if it has not
  int anchors = 0;        ///< number that corrected the filter
  bool position_fixes = false;
  int ideal_nullity = 0;  ///< symmetries that remain
  // Of the filter's information; 0 and empty if it is not monitored
  InformationRank information;
  int spurious_information = 0;  ///< number of remaining symmetries with information from measurements alone
  int by_motion_model = 0;       ///< number of further ones constrained by the motion model
  std::vector<QuantityReport> quantities;
  std::vector<std::string> without_information;  ///< observable quantities without information
};

/// Report on the filter's information, ordered as the scene; the information is empty if it is not monitored,
/// with the reason in `uncovered`. For motion models that preserve the symmetries, as odometry does, all
/// information about them is from measurements.
ObservabilityReport observability_report(const MonitoredInformation& of_filter, const PlanarScene& scene,
                                         const FixedPoints& fixed, const std::string& uncovered = "");
/// `of_measurements`: information with uninformative motions; not used, and may be empty, if no symmetry remains.
ObservabilityReport observability_report(const MonitoredInformation& of_filter,
                                         const MonitoredInformation& of_measurements,
                                         const SpatialScene& scene, const FixedPoints& fixed,
                                         const std::string& uncovered = "");

/// The report for the user, one sentence each: "scale: fixed by 4 anchors".
std::vector<std::string> in_words(const ObservabilityReport& report);

}  // namespace incognita
