// How far a map of points on a plane is from the surveyed one: one-to-one matching, rigid fit, rms.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace incognita {

/// position_in_truth = rotation(turn_rad) * position + shift.
struct PlanarFit {
  double turn_rad = 0;
  Eigen::Vector2d shift{0.0, 0.0};
  Eigen::Vector2d operator()(const Eigen::Vector2d& position) const;
};

/// The rigid motion with the least sum of squared distances from `from` to `to`, point by point (Umeyama 1991
/// without scale). The identity for no points; a shift for one. Throws std::invalid_argument when the lengths
/// differ.
PlanarFit fit_rigid(const std::vector<Eigen::Vector2d>& from, const std::vector<Eigen::Vector2d>& to);

struct MapError {
  struct Match {
    std::size_t estimated = 0, surveyed = 0;  ///< indices
    double distance_m = 0;
  };
  std::vector<Match> matches;          ///< each landmark at most once on either side, the nearest first
  std::vector<std::size_t> unmatched;  ///< estimated, without a surveyed landmark near
  std::vector<std::size_t> missing;    ///< surveyed, without an estimated one near
  std::vector<std::size_t> twice;      ///< estimated, near a surveyed one that a nearer estimate has taken
  double rms_m = 0;                    ///< over the matches; NaN without any
};

/// Estimated against surveyed landmarks in the same frame, matched within `max_distance_m`.
MapError map_error(const std::vector<Eigen::Vector2d>& estimated,
                   const std::vector<Eigen::Vector2d>& surveyed, double max_distance_m);

/// The same after a rigid fit of the matches, begun from a guess and repeated until the matches stay the same
/// (at most 20 times).
struct FittedMapError {
  PlanarFit fit;
  MapError error;
};
FittedMapError fitted_map_error(const std::vector<Eigen::Vector2d>& estimated,
                                const std::vector<Eigen::Vector2d>& surveyed, double max_distance_m,
                                const PlanarFit& guess);

}  // namespace incognita
