#include "incognita/analysis/observability/observability_report.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace incognita {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd in_units(const MatrixXd& Y, const VectorXd& units) {
  return units.asDiagonal() * Y * units.asDiagonal();
}

/// Bound of the rounding error of a zero eigenvalue of a sum of many measurements, from all that was ever
/// added, since marginalization leaves its rounding behind.
double rounding_of(const VectorXd& gathered, const VectorXd& units) {
  if (gathered.size() == 0) return 0;
  constexpr double eps = std::numeric_limits<double>::epsilon();
  return 16 * eps * static_cast<double>(gathered.size()) *
         gathered.cwiseProduct(units.cwiseAbs2()).maxCoeff();
}

/// Covariances of an information matrix. Variances without information are very large instead of infinite: a
/// prior is added, too weak to count as information and strong enough against rounding.
class Covariances {
 public:
  Covariances(const MonitoredInformation& information, const VectorXd& units) : units_(units) {
    const MatrixXd scaled = in_units(information.Y, units);
    prior_ = std::max(1e-8, rounding_of(information.gathered, units) / 4);
    for (int attempt = 0; attempt < 10; ++attempt, prior_ *= 10) {
      MatrixXd with_prior = scaled;
      with_prior.diagonal().array() += prior_;
      llt_.compute(with_prior);
      if (llt_.info() == Eigen::Success) return;
    }
  }
  /// Covariance of functionals, one per row.
  MatrixXd of(const MatrixXd& G) const {
    const MatrixXd scaled = (G * units_.asDiagonal()).transpose();
    const MatrixXd half = llt_.matrixL().solve(scaled);
    return half.transpose() * half;
  }
  /// Threshold of a variance, in squared units, above which it may be due to the prior alone: a direction
  /// along which all n errors change has n times the prior information of one.
  double nothing() const { return 0.1 / (prior_ * static_cast<double>(units_.size())); }

 private:
  VectorXd units_;
  double prior_ = 0;
  Eigen::LLT<MatrixXd> llt_;
};

/// A quantity and the standard deviation that counts as no information.
struct Quantity {
  const char* name;
  const char* unit;
  double size;
};

/// Covariance of the quantities given an information matrix; empty if it is not monitored.
struct Left {
  MatrixXd covariance;
  double nothing = 0;  ///< see Covariances

  /// Standard deviation of a quantity, if it has information beyond the prior.
  std::optional<double> sigma(Eigen::Index i, double size) const {
    if (covariance.size() == 0 || !(covariance(i, i) < nothing * size * size)) return std::nullopt;
    return std::sqrt(std::max(0.0, covariance(i, i)));
  }
};

struct GainedQuantities {
  std::vector<Quantity> quantities;
  Left by_filter;
  std::optional<Left> by_measurements;  ///< if computed separately
};

/// Change of each quantity along each remaining symmetry, relative to its size.
MatrixXd changes(const GainedQuantities& gained_quantities, const VectorXd& position,
                 const RemainingSymmetries& left) {
  const auto count = static_cast<Eigen::Index>(gained_quantities.quantities.size());
  MatrixXd by_generator = MatrixXd::Identity(count, count);
  by_generator.topRows(position.size()) = displacement(position, left.about);
  MatrixXd out = by_generator * left.basis;
  for (Eigen::Index i = 0; i < count; ++i)
    out.row(i) /= gained_quantities.quantities[static_cast<std::size_t>(i)].size;
  for (Eigen::Index i = 0; i < out.cols(); ++i) out.col(i) /= out.col(i).cwiseAbs().maxCoeff();
  return out;
}

/// Number of remaining symmetries with significant information. If rounding required a strong prior in
/// Covariances, a small variance may be due to the prior, which does not count.
int count_gained(const std::vector<Quantity>& quantities, const Left& left, const MatrixXd& along) {
  if (along.cols() == 0 || left.covariance.size() == 0) return 0;
  VectorXd inverse_size(along.rows());
  for (Eigen::Index i = 0; i < along.rows(); ++i)
    inverse_size[i] = 1 / quantities[static_cast<std::size_t>(i)].size;
  const MatrixXd F = along.completeOrthogonalDecomposition().pseudoInverse() * inverse_size.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(F * left.covariance * F.transpose(),
                                                      Eigen::EigenvaluesOnly);
  return static_cast<int>((eigen.eigenvalues().array() < std::min(1.0, left.nothing)).count());
}

void count_spurious(ObservabilityReport& report, const GainedQuantities& gained_quantities,
                    const MatrixXd& along) {
  const int gained = count_gained(gained_quantities.quantities, gained_quantities.by_filter, along);
  report.spurious_information =
      gained_quantities.by_measurements
          ? std::min(gained,
                     count_gained(gained_quantities.quantities, *gained_quantities.by_measurements, along))
          : gained;
  report.by_motion_model = gained - report.spurious_information;
}

void put_quantities(ObservabilityReport& report, const GainedQuantities& gained_quantities,
                    const MatrixXd& along) {
  for (std::size_t i = 0; i < gained_quantities.quantities.size(); ++i) {
    const Quantity& q = gained_quantities.quantities[i];
    const auto row = static_cast<Eigen::Index>(i);
    QuantityReport out;
    out.name = q.name;
    out.unit = q.unit;
    out.ideally_observable = along.cols() == 0 || along.row(row).cwiseAbs().maxCoeff() < 1e-6;
    out.estimated_sigma = gained_quantities.by_filter.sigma(row, q.size);
    out.gained = out.estimated_sigma && *out.estimated_sigma < q.size;
    if (gained_quantities.by_measurements) {
      out.sigma_from_measurements = gained_quantities.by_measurements->sigma(row, q.size);
      out.by_motion_model =
          out.gained && !(out.sigma_from_measurements && *out.sigma_from_measurements < q.size);
    }
    report.quantities.push_back(std::move(out));
  }
}

template <class Scene>
ObservabilityReport compared_with(const MonitoredInformation& of_filter, const Scene& scene,
                                  const FixedPoints& fixed, const std::string& uncovered,
                                  const GainedQuantities& gained_quantities) {
  ObservabilityReport report;
  report.uncovered = uncovered;
  report.anchors = fixed.anchors;
  report.position_fixes = fixed.position_fixes;
  MatrixXd positions = fixed.positions;
  positions.conservativeResize(Scene::dimension, Eigen::NoChange);
  const RemainingSymmetries left = remaining_symmetries(positions);
  report.ideal_nullity = static_cast<int>(left.basis.cols());
  const MatrixXd along = changes(gained_quantities, scene.position(), left);
  put_quantities(report, gained_quantities, along);
  if (!uncovered.empty()) return report;
  report.information = rank_of_information(of_filter, units_of(scene));
  count_spurious(report, gained_quantities, along);
  return report;
}

// Cameras
// ---------------------------------------------------------------------------------------------------------

/// One row per landmark with a position: relative change of its distance from the camera. With fixed points,
/// the last row is for the distance from their centroid.
MatrixXd distances(const SpatialScene& scene, const FixedPoints& fixed, std::vector<std::int64_t>& ids) {
  MatrixXd G = MatrixXd::Zero(static_cast<Eigen::Index>(scene.landmarks.size() + 1), scene.errors);
  Eigen::Index row = 0;
  for (const auto& landmark : scene.landmarks) {
    const auto at = landmark_point(landmark);
    if (!at) continue;
    const Eigen::Vector3d away = at->position - scene.position();
    const Eigen::RowVector3d along = away.transpose() / away.squaredNorm();
    G.row(row).head<3>() = -along;
    G.row(row++).segment(landmark.first, at->J.cols()) = along * at->J;
    ids.push_back(landmark.id);
  }
  if (fixed.positions.cols() > 0) {
    const Eigen::Vector3d away = scene.position() - fixed.positions.rowwise().mean();
    if (away.squaredNorm() > 0) G.row(row++).head<3>() = away.transpose() / away.squaredNorm();
  }
  return G.topRows(row);
}

/// Weights of the minimum-variance mean: (1' C^-1 1)^-1 1' C^-1.
Eigen::RowVectorXd best_weights(const MatrixXd& C) {
  const VectorXd ones = VectorXd::Ones(C.rows());
  const VectorXd raw = C.ldlt().solve(ones);
  return raw.transpose() / raw.sum();
}

/// The velocity in camera axes, d(R' v), and the angular rate.
MatrixXd rates(const SpatialScene& scene) {
  const Eigen::Matrix3d camera_from_world =
      rotation_matrix<double>(free_camera::orientation(scene.camera)).transpose();
  const Eigen::Vector3d v = camera_from_world * free_camera::velocity(scene.camera);
  MatrixXd G = MatrixXd::Zero(6, scene.errors);
  G.block<3, 3>(0, 3) = skew<double>(v);
  G.block<3, 3>(0, 6) = camera_from_world;
  G.block<3, 3>(3, 9).setIdentity();
  return G;
}

/// Functionals of a camera and their covariance: position and rotation about the world's axes (6), rates (6),
/// then the distances. The scale is the weighted mean of the relative changes of the distances.
struct CameraFunctionals {
  std::vector<std::int64_t> ids;  ///< landmarks of the distances
  MatrixXd G, C;
  Eigen::RowVectorXd weights;  ///< weights of the distances
  double nothing = 0;

  Eigen::Index count() const { return G.rows() - 12; }
  /// The scale as a combination of the functionals; zero without distances.
  Eigen::RowVectorXd scale() const {
    Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(G.rows());
    if (count() > 0) row.tail(count()) = weights;
    return row;
  }
};

CameraFunctionals functionals(const MonitoredInformation& information, const SpatialScene& scene,
                              const FixedPoints& fixed) {
  CameraFunctionals f;
  const MatrixXd far = distances(scene, fixed, f.ids);
  f.G = MatrixXd::Zero(12 + far.rows(), scene.errors);
  f.G.block<3, 3>(0, 0).setIdentity();
  f.G.block<3, 3>(3, 3) = rotation_matrix<double>(free_camera::orientation(scene.camera));
  f.G.middleRows<6>(6) = rates(scene);
  f.G.bottomRows(far.rows()) = far;
  const Covariances covariances(information, units_of(scene));
  f.C = covariances.of(f.G);
  f.nothing = covariances.nothing();
  if (f.count() > 0) f.weights = best_weights(f.C.bottomRightCorner(f.count(), f.count()));
  return f;
}

std::vector<Quantity> quantities_of(const SpatialScene& scene) {
  const double length = typical_distance(scene);
  return {{"x", "m", length},
          {"y", "m", length},
          {"z", "m", length},
          {"rotation about x", "rad", 1},
          {"rotation about y", "rad", 1},
          {"rotation about z", "rad", 1},
          {"scale", "1", 1}};
}

Left left_of(const CameraFunctionals& f) {
  MatrixXd S = MatrixXd::Zero(7, f.G.rows());
  S.topLeftCorner<6, 6>().setIdentity();
  S.row(6) = f.scale();
  Left out{S * f.C * S.transpose(), f.nothing};
  if (f.count() == 0) out.covariance(6, 6) = 10 * f.nothing;
  return out;
}

/// Quantities observable in any frame and scale that lack information: depths and rates; depths and velocity
/// relative to the scale if that is unknown.
std::vector<std::string> not_gained(const CameraFunctionals& f, const SpatialScene& scene, bool scale_known) {
  MatrixXd relative = MatrixXd::Identity(f.G.rows(), f.G.rows());
  if (!scale_known) {
    const Eigen::Vector3d v = rotation_matrix<double>(free_camera::orientation(scene.camera)).transpose() *
                              free_camera::velocity(scene.camera);
    relative.middleRows<3>(6) -= v * f.scale();
    for (Eigen::Index i = 12; i < relative.rows(); ++i) relative.row(i) -= f.scale();
  }
  const VectorXd variances = (relative * f.C * relative.transpose()).diagonal();
  const double length = typical_distance(scene);
  std::vector<std::string> names;
  if (variances.segment<3>(6).maxCoeff() > length * length) names.emplace_back("velocity");
  if (variances.segment<3>(9).maxCoeff() > 1) names.emplace_back("angular rate");
  for (std::size_t i = 0; i < f.ids.size(); ++i)
    if (variances[12 + static_cast<Eigen::Index>(i)] > 1)
      names.push_back("depth of landmark " + std::to_string(f.ids[i]));
  for (const auto& landmark : scene.landmarks)
    if (!landmark_point(landmark)) names.push_back("depth of landmark " + std::to_string(landmark.id));
  return names;
}

// Text
// ---------------------------------------------------------------------------------------------------------

std::string number(double value, const char* unit) {
  char text[64];
  std::snprintf(text, sizeof text, "%.2g%s", value, unit);
  return text;
}

std::string sigma_in_words(double sigma, const std::string& unit) {
  if (unit == "rad") return number(sigma * 57.29577951308232, " deg");
  if (unit == "1") return number(sigma * 100, " %");
  return number(sigma, " m");
}

std::string fixed_by(const ObservabilityReport& report) {
  std::string text;
  if (report.anchors > 0)
    text = std::to_string(report.anchors) + (report.anchors == 1 ? " anchor" : " anchors");
  if (report.position_fixes) text += text.empty() ? "position fixes" : " and position fixes";
  return text;
}

/// Quantities reported under one name.
struct Group {
  const char* word;
  std::vector<const QuantityReport*> members;
};

std::vector<Group> groups_of(const ObservabilityReport& report) {
  Group position{"position", {}}, turns{"orientation", {}}, scale{"scale", {}};
  for (const QuantityReport& q : report.quantities)
    (q.unit == "m" ? position : q.unit == "rad" ? turns : scale).members.push_back(&q);
  if (turns.members.size() == 1) turns.word = "heading";
  std::vector<Group> groups{position, turns};
  if (!scale.members.empty()) groups.push_back(scale);
  return groups;
}

std::string of_observable(const Group& group, const ObservabilityReport& report) {
  const bool all = std::all_of(group.members.begin(), group.members.end(), [](auto* q) { return q->gained; });
  const std::string by = fixed_by(report);
  if (!report.uncovered.empty()) return std::string(group.word) + ": observable with " + by;
  if (all) return std::string(group.word) + ": fixed by " + by;
  return std::string(group.word) + ": observable with " + by + ", but with too little information so far";
}

/// The best known of a group's unobservable quantities with information, from measurements or from motions.
const QuantityReport* best_gained(const Group& group, bool by_motion_model) {
  const QuantityReport* best = nullptr;
  for (const QuantityReport* q : group.members)
    if (!q->ideally_observable && q->gained && q->by_motion_model == by_motion_model &&
        (!best || *q->estimated_sigma < *best->estimated_sigma))
      best = q;
  return best;
}

std::string of_unobservable(const Group& group, const ObservabilityReport& report) {
  std::string text = std::string(group.word) + ": unobservable";
  if (const std::string by = fixed_by(report); !by.empty()) text += " with " + by;
  const bool many = group.members.size() > 1;
  const QuantityReport* by_measurements = best_gained(group, false);
  if (by_measurements)
    text +=
        ", but the filter has spurious information from measurements" +
        (many ? " on " + by_measurements->name : std::string()) + ": sigma " +
        sigma_in_words(by_measurements->sigma_from_measurements.value_or(*by_measurements->estimated_sigma),
                       by_measurements->unit);
  if (const QuantityReport* q = best_gained(group, true))
    text += (by_measurements ? "; information" : " by measurements; information") +
            (many ? " on " + q->name : std::string()) + " from the motion model: sigma " +
            sigma_in_words(*q->estimated_sigma, q->unit);
  return text;
}

std::string listed(const std::vector<std::string>& names) {
  constexpr std::size_t most = 8;
  std::string text;
  for (std::size_t i = 0; i < std::min(most, names.size()); ++i) text += (i ? ", " : "") + names[i];
  if (names.size() > most) text += " and " + std::to_string(names.size() - most) + " more";
  return text;
}

}  // namespace

double InformationRank::gap() const { return least_counted / std::max(most_not_counted, tolerance / 1e3); }

InformationRank rank_of_information(const MonitoredInformation& information, const VectorXd& units) {
  constexpr double unclear = 30;  // factor
  InformationRank out;
  out.errors = static_cast<int>(information.Y.rows());
  if (information.Y.size() == 0) return out;
  const MatrixXd scaled = in_units(information.Y, units);
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(scaled, Eigen::EigenvaluesOnly);
  out.tolerance = rounding_of(information.gathered, units);
  out.ambiguous = out.tolerance * unclear > 1;      // rounding hides significant information
  for (const double value : eigen.eigenvalues()) {  // in increasing order
    if (value > out.tolerance && out.rank++ == 0) out.least_counted = value;
    if (!(value > out.tolerance)) out.most_not_counted = std::max(0.0, value);
    out.ambiguous = out.ambiguous || (value > out.tolerance / unclear && value < out.tolerance * unclear);
  }
  return out;
}

ObservabilityReport observability_report(const MonitoredInformation& of_filter, const PlanarScene& scene,
                                         const FixedPoints& fixed, const std::string& uncovered) {
  const double length = typical_distance(scene);
  GainedQuantities gained_quantities{{{"x", "m", length}, {"y", "m", length}, {"heading", "rad", 1}}, {}, {}};
  if (uncovered.empty()) {
    const Covariances covariances(of_filter, units_of(scene));
    gained_quantities.by_filter = {covariances.of(MatrixXd::Identity(3, scene.errors)),
                                   covariances.nothing()};
  }
  return compared_with(of_filter, scene, fixed, uncovered, gained_quantities);
}

ObservabilityReport observability_report(const MonitoredInformation& of_filter,
                                         const MonitoredInformation& of_measurements,
                                         const SpatialScene& scene, const FixedPoints& fixed,
                                         const std::string& uncovered) {
  GainedQuantities gained_quantities{quantities_of(scene), {}, {}};
  if (!uncovered.empty()) return compared_with(of_filter, scene, fixed, uncovered, gained_quantities);
  const CameraFunctionals f = functionals(of_filter, scene, fixed);
  gained_quantities.by_filter = left_of(f);
  if (of_measurements.Y.size() > 0)
    gained_quantities.by_measurements = left_of(functionals(of_measurements, scene, fixed));
  ObservabilityReport report = compared_with(of_filter, scene, fixed, uncovered, gained_quantities);
  report.without_information = not_gained(f, scene, report.quantities.back().ideally_observable);
  return report;
}

std::vector<std::string> in_words(const ObservabilityReport& report) {
  std::vector<std::string> lines;
  for (const Group& group : groups_of(report)) {
    const bool observable = std::all_of(group.members.begin(), group.members.end(),
                                        [](auto* q) { return q->ideally_observable; });
    lines.push_back(observable ? of_observable(group, report) : of_unobservable(group, report));
  }
  if (!report.without_information.empty())
    lines.push_back("no information so far on: " + listed(report.without_information));
  if (!report.uncovered.empty())
    lines.push_back("the filter's information is not monitored: " + report.uncovered);
  else if (report.information.ambiguous)
    lines.push_back("the rank of the filter's information, " + std::to_string(report.information.rank) +
                    " of " + std::to_string(report.information.errors) +
                    ", is ambiguous: an eigenvalue is close to rounding");
  return lines;
}

}  // namespace incognita
