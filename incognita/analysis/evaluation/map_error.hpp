// Error of a planar point map against a surveyed one: one-to-one matching, rigid fit, rms.
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

/// Rigid motion with the least sum of squared distances from `from` to `to`, point by point (Umeyama 1991 without
/// scale). The identity for no points; a shift for one. Throws std::invalid_argument if the sizes differ.
PlanarFit fit_rigid(const std::vector<Eigen::Vector2d>& from, const std::vector<Eigen::Vector2d>& to);

struct MapError {
  struct Match {
    std::size_t estimated = 0, surveyed = 0;  ///< indices
    double distance_m = 0;
  };
  std::vector<Match> matches;          ///< one-to-one, the nearest first
  std::vector<std::size_t> unmatched;  ///< estimated, with no surveyed landmark near
  std::vector<std::size_t> missing;    ///< surveyed, with no estimated landmark near
  /// Duplicates: estimated, near a surveyed landmark that a nearer estimate has taken.
  std::vector<std::size_t> twice;
  double rms_m = 0;  ///< over the matches; NaN without any
};

/// Matches estimated and surveyed landmarks in the same frame within `max_distance_m`.
MapError map_error(const std::vector<Eigen::Vector2d>& estimated,
                   const std::vector<Eigen::Vector2d>& surveyed, double max_distance_m);

/// The same after a rigid fit of the matches, starting from a guess and iterated until the matches no longer
/// change (at most 20 times).
struct FittedMapError {
  PlanarFit fit;
  MapError error;
};
FittedMapError fitted_map_error(const std::vector<Eigen::Vector2d>& estimated,
                                const std::vector<Eigen::Vector2d>& surveyed, double max_distance_m,
                                const PlanarFit& guess);

}  // namespace incognita
