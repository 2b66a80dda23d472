// Data association of measurements and landmarks.
//
// Both methods choose among candidate pairings: a measurement, a landmark, and the linearized measurement
// that results if they belong together. Nearest neighbor decides each pairing individually. Joint
// compatibility branch and bound (Neira, Tardos, IEEE Trans. Robotics and Automation 2001) finds the largest
// set of jointly compatible pairings, whose innovations are correlated through the vehicle.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "incognita/belief/any_belief.hpp"
#include "incognita/belief/linearized.hpp"

namespace incognita {

struct Pairing {
  int measurement = 0;
  int landmark = 0;                  ///< any unique number
  LinearizedMeasurement linearized;  ///< prediction of the landmark, residual of the measurement
};

struct AssociationSettings {
  double probability = 0.95;         ///< of the chi-square gate, for a correct pairing or set of pairings
  std::int64_t max_nodes = 100'000;  ///< limit of the joint search, which then returns the best set so far
};

struct Association {
  std::vector<int> chosen;  ///< indices of pairings; at most one per measurement and per landmark
  double distance2 = 0;     ///< r' S^-1 r, joint
  std::int64_t nodes = 0;   ///< visited by the joint search
  bool capped = false;      ///< max_nodes was reached: a better set may exist
};

/// A candidate pairing and its squared Mahalanobis distance.
struct Candidate {
  int measurement = 0, landmark = 0;
  double distance2 = 0;  ///< r' S^-1 r
};

/// Greedy assignment, nearest first: indices of candidates, each measurement and each landmark at most once.
std::vector<int> nearest_first(std::span<const Candidate> candidates);

/// r' S^-1 r of each pairing; infinite when S is not positive definite or a number is not finite.
std::vector<double> individual_distances(const AnyBelief& belief, std::span<const Pairing> pairings);

/// The largest set of pairings that are individually and jointly compatible; in a tie the set with the
/// smallest joint distance.
Association jointly_compatible(const AnyBelief& belief, std::span<const Pairing> pairings,
                               const AssociationSettings& settings);

}  // namespace incognita
