// The estimator of a vehicle on a plane that measures ranges and bearings: odometry in, map and pose out.
#pragma once

#include <cstdint>
#include <vector>

#include "incognita/messages/command.hpp"
#include "incognita/messages/observation.hpp"
#include "incognita/messages/tick.hpp"
#include "incognita/slam/points/planar_association.hpp"
#include "incognita/slam/points/planar_estimate.hpp"
#include "incognita/slam/points/planar_settings.hpp"

namespace incognita {

class PlanarEstimator {
 public:
  using Estimate = PlanarEstimate;

  /// Throws std::invalid_argument, naming the setting, for words that none of its settings knows and for
  /// filters that make no sense together.
  /// `anchor_identities`: how the sensor tells the anchors of the settings, in their order, for association
  /// by identity; may be empty otherwise.
  explicit PlanarEstimator(const PlanarSlamSettings& settings,
                           std::vector<std::int64_t> anchor_identities = {});

  /// One tick: predict, associate, correct, give birth. The command moves nothing that odometry does not
  /// tell.
  void update(PlanarEstimate& estimate, const Command& command, const Observation& seen,
              const Tick& tick) const;

 private:
  void start(PlanarEstimate& estimate, const Observation& seen, const Tick& tick) const;
  std::vector<AffineLook> matched_looks(const PlanarEstimate& estimate, const Observation& seen,
                                        const ScanAssociation& found) const;
  void tell_looks(PlanarEstimate& estimate, const Observation& seen, const ScanAssociation& found) const;
  void correct(PlanarEstimate& estimate, const Observation& seen, const ScanAssociation& found) const;
  void refuse(PlanarEstimate& estimate, const ScanAssociation& found) const;
  void give_births(PlanarEstimate& estimate, const Observation& seen, const ScanAssociation& found) const;
  void judge(PlanarEstimate& estimate, bool map_was_empty) const;
  void refresh_entropy(PlanarEstimate& estimate) const;

  PlanarSlamSettings settings_;
  std::vector<std::int64_t> anchor_identities_;
};

}  // namespace incognita
