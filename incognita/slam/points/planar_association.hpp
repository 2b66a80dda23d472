// Which landmark each detection of a scan is of, and which are of landmarks not seen before.
#pragma once

#include <vector>

#include "incognita/slam/points/planar_estimate.hpp"
#include "incognita/slam/points/planar_settings.hpp"

namespace incognita {

struct ScanAssociation {
  struct Match {
    std::size_t detection = 0;
    std::size_t landmark = 0;  ///< index in the catalogue
  };
  std::vector<Match> matches;
  std::vector<std::size_t> births;   ///< indices of detections
  std::vector<std::size_t> refused;  ///< told to be of a known landmark, and outside its gate
  bool capped = false;               ///< the joint search reached max_nodes: a better answer may exist
};

/// Detections that are neither matched, born nor refused are left alone: near a landmark, but not near
/// enough.
ScanAssociation associate_scan(const PlanarEstimate& estimate, const std::vector<Detection>& detections,
                               const PlanarSlamSettings& settings);

}  // namespace incognita
