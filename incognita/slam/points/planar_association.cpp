#include "incognita/slam/points/planar_association.hpp"

#include <algorithm>
#include <cmath>

#include "incognita/math/gaussian.hpp"
#include "incognita/models/range_bearing.hpp"
#include "incognita/slam/points/association.hpp"
#include "incognita/slam/points/planar_looks.hpp"

namespace incognita {
namespace {

/// By what the sensor says: each identity once, the first time as a birth. Without an identity there is
/// nothing to go by, and such a detection is left alone.
ScanAssociation associate_known(const PlanarEstimate& e, const std::vector<Detection>& detections,
                                const PlanarSlamSettings& settings) {
  const double gate = chi_square_quantile(settings.association.gate_probability, 2);
  ScanAssociation out;
  std::vector<std::int64_t> taken;
  for (std::size_t d = 0; d < detections.size(); ++d) {
    const std::int64_t identity = detections[d].identity;
    if (identity == Detection::unknown || !is_usable(detections[d]) ||
        std::find(taken.begin(), taken.end(), identity) != taken.end())
      continue;
    taken.push_back(identity);
    const auto known = std::find_if(e.catalogue.begin(), e.catalogue.end(),
                                    [&](const PlanarLandmark& l) { return l.identity == identity; });
    if (known == e.catalogue.end()) {
      out.births.push_back(d);
      continue;
    }
    const auto seen = look_at(e, *known, detections[d], settings);
    const Pairing pairing{0, 0, seen ? seen->look : AffineLook{}};
    if (seen && individual_distances(e.belief, {&pairing, 1})[0] <= gate)
      out.matches.push_back({d, static_cast<std::size_t>(known - e.catalogue.begin())});
    else
      out.refused.push_back(d);
  }
  return out;
}

/// How far apart two places are as range and bearing from the vehicle have them, m.
double apart(const Detection& detection, const Eigen::Vector2d& predicted) {
  const Eigen::Vector3d here = Eigen::Vector3d::Zero();
  const Eigen::Vector2d z(detection.range_m, detection.bearing_rad);
  return (RangeBearing::j<double>(here, z) - RangeBearing::j<double>(here, predicted)).norm();
}

class UnknownAssociation {
 public:
  UnknownAssociation(const PlanarEstimate& e, const std::vector<Detection>& detections,
                     const PlanarSlamSettings& settings)
      : e_(e),
        detections_(detections),
        settings_(settings),
        gate_(chi_square_quantile(settings.association.gate_probability, 2)),
        birth_gate_(chi_square_quantile(settings.association.birth_probability, 2)) {
    for (std::size_t d = 0; d < detections.size(); ++d) {
      novel_.push_back(is_usable(detections[d]));
      if (!novel_.back()) continue;
      for (std::size_t l = 0; l < e.catalogue.size(); ++l) consider(d, l);
    }
  }

  ScanAssociation run() const {
    const DataAssociationSettings& s = settings_.association;
    const AssociationSettings joint{s.gate_probability, s.max_nodes};
    const Association chosen = s.method == "nearest" ? nearest_neighbours(e_.belief, pairings_, joint)
                                                     : jointly_compatible(e_.belief, pairings_, joint);
    ScanAssociation out;
    out.capped = chosen.capped;
    for (const int p : chosen.chosen)
      out.matches.push_back({static_cast<std::size_t>(pairings_[static_cast<std::size_t>(p)].measurement),
                             static_cast<std::size_t>(pairings_[static_cast<std::size_t>(p)].landmark)});
    for (std::size_t d = 0; d < detections_.size(); ++d)
      if (novel_[d] && !near_another(d, out.births)) out.births.push_back(d);
    return out;
  }

 private:
  /// What is inside the wide gate of any landmark, or too near it, is not of a new one; what is inside the
  /// narrow one may be of that landmark. Only those few are kept: of all pairs there are detections times
  /// landmarks.
  void consider(std::size_t detection, std::size_t landmark) {
    const auto seen = look_at(e_, e_.catalogue[landmark], detections_[detection], settings_);
    if (!seen) return;
    const Pairing pairing{static_cast<int>(detection), static_cast<int>(landmark), seen->look};
    const double distance = individual_distances(e_.belief, {&pairing, 1})[0];
    if (distance <= birth_gate_ ||
        apart(detections_[detection], seen->predicted) < settings_.association.birth_distance_m)
      novel_[detection] = false;
    if (distance <= gate_) pairings_.push_back(pairing);
  }

  /// Two detections of one scan so near each other are of one new landmark.
  bool near_another(std::size_t d, const std::vector<std::size_t>& births) const {
    return std::any_of(births.begin(), births.end(), [&](std::size_t other) {
      const Eigen::Vector2d z(detections_[other].range_m, detections_[other].bearing_rad);
      return apart(detections_[d], z) < settings_.association.birth_distance_m;
    });
  }

  const PlanarEstimate& e_;
  const std::vector<Detection>& detections_;
  const PlanarSlamSettings& settings_;
  double gate_, birth_gate_;
  std::vector<Pairing> pairings_;
  std::vector<bool> novel_;
};

}  // namespace

ScanAssociation associate_scan(const PlanarEstimate& estimate, const std::vector<Detection>& detections,
                               const PlanarSlamSettings& settings) {
  if (settings.association.method == "known") return associate_known(estimate, detections, settings);
  return UnknownAssociation(estimate, detections, settings).run();
}

}  // namespace incognita
