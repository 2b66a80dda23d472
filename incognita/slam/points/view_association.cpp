#include "incognita/slam/points/view_association.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <numeric>
#include <optional>

#include "incognita/math/gaussian.hpp"
#include "incognita/slam/mapper/measurements.hpp"
#include "incognita/slam/points/association.hpp"

namespace incognita {
namespace {

bool has_anchor_identity(const PointDetection& detection, const EstimatorSettings& settings) {
  return settings.anchors_have_identity && settings.anchors.count(detection.identity) > 0;
}

std::vector<std::size_t> in_order(const std::vector<PointDetection>& detections,
                                  const EstimatorSettings& settings) {
  std::vector<std::size_t> order(detections.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
    const PointDetection &a = detections[i], &b = detections[j];
    const bool a_named = has_anchor_identity(a, settings), b_named = has_anchor_identity(b, settings);
    if (a_named != b_named) return a_named;
    if (a_named) return a.identity < b.identity;
    return std::lexicographical_compare(a.z.begin(), a.z.end(), b.z.begin(), b.z.end());
  });
  return order;
}

/// Gating and association of the detections without identity.
class UnidentifiedDetections {
 public:
  UnidentifiedDetections(const Estimate& e, int body, const std::vector<PointDetection>& detections,
                         const std::vector<std::size_t>& unidentified, const EstimatorSettings& settings)
      : e_(e), body_(body), detections_(detections), settings_(settings) {
    for (const std::size_t s : unidentified)
      if (is_usable(sensor_of(settings, body, detections[s].sensor).sensor, detections[s].z))
        usable_.push_back(s);
    if (usable_.empty()) return;
    const auto rows = static_cast<int>(detections_[usable_.front()].z.size());
    gate_ = chi_square_quantile(settings.association.gate_probability, rows);
    initialization_gate_ = chi_square_quantile(settings.association.initialization_probability, rows);
    is_new_.assign(usable_.size(), true);
    for (const std::size_t s : usable_) points_.push_back(point_of(e, body, detections[s], settings));
    for (const auto& [id, landmark] : e.landmarks) {
      if (landmark.fixed && settings.anchors_have_identity) continue;
      if (is_measurable(landmark, sensor().sensor)) gate_against(id);
    }
  }

  void associate(ViewAssociation& out) const {
    const AssociationSettings joint{settings_.association.gate_probability, settings_.association.max_nodes};
    if (settings_.association.method == DataAssociationSettings::Method::joint) {
      const Association found = jointly_compatible(e_.belief, pairings_, joint);
      out.capped = found.capped;
      for (const int p : found.chosen)
        take(pairings_[static_cast<std::size_t>(p)].measurement,
             pairings_[static_cast<std::size_t>(p)].landmark, out);
    } else {
      for (const int c : nearest_first(candidates_))
        take(candidates_[static_cast<std::size_t>(c)].measurement,
             candidates_[static_cast<std::size_t>(c)].landmark, out);
    }
    std::vector<std::size_t> chosen;
    for (std::size_t s = 0; s < usable_.size(); ++s) {
      if (!is_new_[s] || near_another(s, chosen)) continue;
      chosen.push_back(s);
      out.candidates.push_back(usable_[s]);
    }
  }

 private:
  /// All detections are of one sensor.
  const PointSensor& sensor() const {
    return sensor_of(settings_, body_, detections_[usable_.front()].sensor);
  }

  PointDetection first_as(std::int64_t number) const {
    PointDetection detection = detections_[usable_.front()];
    detection.identity = number;
    return detection;
  }

  void take(int measurement, int landmark, ViewAssociation& out) const {
    out.landmarks[usable_[static_cast<std::size_t>(measurement)]] =
        numbers_[static_cast<std::size_t>(landmark)];
  }

  /// The prediction of a landmark is shared by all detections; only innovation and noise differ.
  void gate_against(std::int64_t number) {
    auto expected = linearize_detection(e_, body_, false, first_as(number), settings_);
    if (!expected) return;
    const std::optional<SmallVector> at = position(number);
    e_.belief.innovation_covariance({&expected->linearized, 1}, S_);
    const SmallMatrix predicted_cov = S_ - expected->linearized.R;
    for (std::size_t s = 0; s < usable_.size(); ++s) {
      if (at && points_[s] && near(*points_[s], *at)) is_new_[s] = false;
      set_residual(*expected, sensor(), detections_[usable_[s]].z);
      const Eigen::LLT<SmallMatrix> llt(SmallMatrix(predicted_cov + expected->linearized.R));
      if (llt.info() != Eigen::Success) continue;
      const double distance = llt.matrixL().solve(SmallVector(expected->linearized.residual)).squaredNorm();
      if (distance <= initialization_gate_) is_new_[s] = false;
      if (distance > gate_ || !expected->is_linear) continue;
      const int measurement = static_cast<int>(s), landmark = static_cast<int>(numbers_.size());
      candidates_.push_back({measurement, landmark, distance});
      if (settings_.association.method == DataAssociationSettings::Method::joint)
        pairings_.push_back({measurement, landmark, expected->linearized});
    }
    numbers_.push_back(number);
  }

  /// Position of a landmark or anchor in the map frame; nothing at infinity.
  std::optional<SmallVector> position(std::int64_t number) const {
    const Landmark& landmark = e_.landmarks.at(number);
    if (landmark.fixed) return anchor_position(e_, landmark.position);
    const auto at = position_of(landmark.form, e_.belief.mean(landmark.block));
    return at ? std::optional(at->position) : std::nullopt;
  }

  bool near(const SmallVector& a, const SmallVector& b) const {
    return (a - b).norm() < settings_.association.initialization_distance_m;
  }

  /// Whether a detection is so near to a chosen one that both belong to one new landmark.
  bool near_another(std::size_t s, const std::vector<std::size_t>& chosen) const {
    return points_[s] && std::any_of(chosen.begin(), chosen.end(), [&](std::size_t other) {
             return points_[other] && near(*points_[s], *points_[other]);
           });
  }

  const Estimate& e_;
  int body_;
  const std::vector<PointDetection>& detections_;
  const EstimatorSettings& settings_;
  std::vector<std::size_t> usable_;                 ///< indices of detections
  std::vector<std::optional<SmallVector>> points_;  ///< of each in the map frame
  std::vector<bool> is_new_;                        ///< of each: outside every initialization gate
  double gate_ = 0, initialization_gate_ = 0;
  std::vector<std::int64_t> numbers_;  ///< landmarks of candidates_ and pairings_
  std::vector<Candidate> candidates_;  ///< pairings inside the gate
  std::vector<Pairing> pairings_;      ///< the same, linearized, for the joint search
  Eigen::MatrixXd S_;
};

}  // namespace

ViewAssociation associate_view(const Estimate& e, int body, const std::vector<PointDetection>& detections,
                               const EstimatorSettings& settings) {
  ViewAssociation out;
  out.order = in_order(detections, settings);
  out.landmarks.assign(detections.size(), Detection::unknown);
  std::vector<std::size_t> unidentified;
  for (const std::size_t s : out.order) {
    if (has_anchor_identity(detections[s], settings))
      out.landmarks[s] = detections[s].identity;
    else
      unidentified.push_back(s);
  }
  UnidentifiedDetections(e, body, detections, unidentified, settings).associate(out);
  return out;
}

}  // namespace incognita
