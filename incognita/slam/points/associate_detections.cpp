#include "incognita/slam/points/associate_detections.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>

#include "incognita/math/gaussian.hpp"
#include "incognita/slam/mapper/landmarks.hpp"
#include "incognita/slam/mapper/measurements.hpp"
#include "incognita/slam/points/choose_candidates.hpp"
#include "incognita/slam/points/view_association.hpp"

namespace incognita {
namespace {

double distance_of(const LinearizedMeasurement& measurement, const SmallMatrix& S) {
  return measurement.residual.dot(S.llt().solve(SmallVector(measurement.residual)));
}

/// Chi-square gate by the rows of a measurement; open for a probability of 1.
class Gate {
 public:
  explicit Gate(double probability) : shut_(probability < 1) {
    for (int rows = 1; shut_ && rows <= max_measurement_rows; ++rows)
      most_[static_cast<std::size_t>(rows)] = chi_square_quantile(probability, rows);
  }
  bool has(double distance, int rows) const {
    return !shut_ || distance <= most_[static_cast<std::size_t>(rows)];
  }

 private:
  bool shut_;
  std::array<double, max_measurement_rows + 1> most_{};
};

bool is_anchor(const Estimate& e, std::int64_t id) {
  const auto found = e.landmarks.find(id);
  return found != e.landmarks.end() && found->second.fixed;
}

PointDetection detection_of(const Match& match) { return {match.id, match.measured, match.sensor}; }

void note(Estimate& e, int body, bool of_body, std::int64_t id, const PointDetection& detection) {
  Match& match = e.last.matches.emplace_back();
  match.body = body;
  match.sensor = detection.sensor;
  match.of_body = of_body;
  match.anchor = !of_body && is_anchor(e, id);
  match.id = id;
  if (detection.z.size() <= max_measurement_rows) match.measured = detection.z;  // else it is not usable
}

/// One pass over the detections of a tick.
struct DetectionAssociation {
  Estimate& e;
  const EstimatorSettings& settings;
  Inliers& inliers;
  Gate gate;

  /// Linearizes a detection of an anchor, a mapped landmark or a body, and gates it.
  void linearize_and_gate(std::size_t index) {
    Match& match = e.last.matches[index];
    if (!is_usable(sensor_of(settings, match.body, match.sensor).sensor, match.measured)) return;
    const auto at = linearize_detection(e, match.body, match.of_body, detection_of(match), settings);
    if (!at) return;
    match.predicted = at->predicted;
    if (!at->is_linear) return;
    e.belief.innovation_covariance({&at->linearized, 1}, inliers.S);
    match.innovation_cov = inliers.S;
    const bool inside = gate.has(distance_of(at->linearized, match.innovation_cov), at->linearized.rows());
    match.outcome = inside ? MatchOutcome::matched : MatchOutcome::outlier;
    if (!inside) return;
    inliers.indices.push_back(index);
    inliers.measurements.push_back(at->linearized);
  }

  /// Whether a usable detection of the same landmark by the same sensor precedes this match.
  bool was_measured(std::size_t index) const {
    const Match& match = e.last.matches[index];
    return std::any_of(e.last.matches.begin(), e.last.matches.begin() + static_cast<std::ptrdiff_t>(index),
                       [&](const Match& other) {
                         return other.body == match.body && other.sensor == match.sensor && !other.of_body &&
                                other.id == match.id &&
                                is_usable(sensor_of(settings, other.body, other.sensor).sensor,
                                          other.measured);
                       });
  }

  /// Association by identity, one detection per landmark and sensor. Detections without identity are ignored.
  void by_identity(int body, const std::vector<PointDetection>& detections) {
    for (const PointDetection& detection : detections) {
      note(e, body, false, detection.identity, detection);
      const std::size_t index = e.last.matches.size() - 1;
      if (was_measured(index)) continue;
      linearize_and_gate(index);
      if (e.landmarks.count(detection.identity) == 0 && detection.identity != Detection::unknown)
        inliers.candidates.push_back(index);
    }
  }

  /// Association by position. Two sensors may detect the same new landmark, and the second detection can be
  /// associated only once the landmark is in the map: therefore one sensor per tick initializes landmarks.
  void by_position(int body, const std::vector<PointDetection>& detections) {
    const ViewAssociation taken = associate_view(e, body, detections, settings);
    e.last.association_capped = e.last.association_capped || taken.capped;
    const std::size_t first = e.last.matches.size();
    for (std::size_t s = 0; s < detections.size(); ++s)
      note(e, body, false, taken.landmarks[s], detections[s]);
    for (const std::size_t s : taken.order) linearize_and_gate(first + s);
    if (!inliers.candidates.empty()) return;
    for (const std::size_t s : taken.candidates) inliers.candidates.push_back(first + s);
  }

  void landmarks(int body, const std::vector<PointDetection>& detections) {
    if (settings.association.method == DataAssociationSettings::Method::known)
      return by_identity(body, detections);
    const std::size_t sensors = settings.bodies[static_cast<std::size_t>(body)].sensors.size();
    if (sensors <= 1) return by_position(body, detections);
    for (std::size_t k = 0; k < sensors; ++k) {
      std::vector<PointDetection> own;
      std::copy_if(detections.begin(), detections.end(), std::back_inserter(own),
                   [&](const PointDetection& d) { return d.sensor == static_cast<int>(k); });
      by_position(body, own);
    }
  }

  /// A body that waits where it was lost may be elsewhere.
  void bodies(int body, const std::vector<PointDetection>& detections) {
    for (const PointDetection& detection : detections) {
      note(e, body, true, detection.identity, detection);
      if (e.bodies[static_cast<std::size_t>(detection.identity)].waits) continue;
      linearize_and_gate(e.last.matches.size() - 1);
    }
  }
};

}  // namespace

void associate_detections(Estimate& e, const Observation& observation, const EstimatorSettings& settings,
                          Inliers& inliers) {
  inliers.clear();
  DetectionAssociation association{e, settings, inliers, Gate(settings.filter.gate_probability)};
  for (std::size_t i = 0; i < observation.bodies.size(); ++i) {
    association.landmarks(static_cast<int>(i), observation.bodies[i].landmarks);
    association.bodies(static_cast<int>(i), observation.bodies[i].vehicles);
  }
}

void append_relinearized(const Estimate& e, const Inliers& inliers, const EstimatorSettings& settings,
                         std::vector<LinearizedMeasurement>& measurements) {
  for (const std::size_t index : inliers.indices) {
    const Match& match = e.last.matches[index];
    const auto at = linearize_detection(e, match.body, match.of_body, detection_of(match), settings);
    measurements.push_back(at ? at->linearized : LinearizedMeasurement{});
  }
}

void initialize_candidates(Estimate& e, const Inliers& inliers, const EstimatorSettings& settings) {
  const bool by_identity = settings.association.method == DataAssociationSettings::Method::known;
  for (const std::size_t index : chosen_candidates(e, inliers.candidates, settings)) {
    Match& match = e.last.matches[index];
    const std::int64_t id = by_identity ? match.id : new_id(e);
    if (e.landmarks.count(id) > 0) continue;  // already initialized by another body
    PointDetection detection = detection_of(match);
    detection.identity = id;
    if (!initialize_from_detection(e, match.body, detection, settings)) continue;
    match.id = id;
    match.outcome = MatchOutcome::initialized;
  }
}

}  // namespace incognita
