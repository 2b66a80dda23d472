// The true positions of the landmarks of a map of a point-landmark world.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "incognita/analysis/evaluation/mapped_share.hpp"
#include "incognita/app/loop/map_truth.hpp"
#include "incognita/world/points/point_world.hpp"

namespace incognita {

/// The parts of the world are its points that are not known as anchors.
class PointMapTruth final : public MapTruth {
 public:
  /// `known`: identities of the anchors. `associations`: null if the map has the true identities; otherwise a landmark stands for
  /// the point whose detection initialized it, and put() expects the true identities of the same tick.
  PointMapTruth(const PointLandmarks& points, const std::vector<std::int64_t>& known,
                std::shared_ptr<const AssociationTruth> associations);

  void put(const std::optional<Truth>& truth, const Estimator& estimator, Snapshot& snapshot) override;
  void state(StateArchive& archive) override;

 private:
  struct Part {
    Eigen::Vector3d position =
        Eigen::Vector3d::Zero();  ///< m; coordinates that the world does not have are 0
    std::size_t index = 0;
  };
  const Part* part_of(std::int64_t landmark) const;

  std::map<std::int64_t, Part> parts_;  ///< by true identity
  std::shared_ptr<const AssociationTruth> associations_;
  std::map<std::int64_t, std::int64_t> identity_of_;  ///< by landmark, of a map without identities
  MappedShare mapped_;
};

}  // namespace incognita
