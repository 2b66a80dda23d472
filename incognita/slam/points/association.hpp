// Which measurement is of which landmark.
//
// Both ways work on pairings that could be: a measurement, a landmark, and the look that the one would be of
// the other. Nearest neighbour decides each pairing by itself; joint compatibility branch and bound (Neira,
// Tardos, IEEE Trans. Robotics and Automation 2001) takes the largest set of pairings whose innovations,
// correlated as they are through the vehicle, are probable together.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "incognita/belief/any_belief.hpp"
#include "incognita/belief/linearized.hpp"

namespace incognita {

struct Pairing {
  int measurement = 0;
  int landmark = 0;                  ///< any number that tells landmarks apart
  LinearizedMeasurement linearized;  ///< of that landmark, with the residual of that measurement
};

struct AssociationSettings {
  double probability = 0.95;         ///< a right pairing, or set of them, is inside its chi-square gate
  std::int64_t max_nodes = 100'000;  ///< of the joint search; then the best set so far is taken
};

struct Association {
  std::vector<int> chosen;  ///< indices into the pairings: at most one per measurement and per landmark
  double distance2 = 0;     ///< r' S^-1 r: of all innovations together, or the sum of each by itself
  std::int64_t nodes = 0;   ///< of the joint search
  bool capped = false;      ///< max_nodes was reached: a better set may exist
};

/// A pairing that could be, and how far its innovation is from none.
struct Candidate {
  int measurement = 0, landmark = 0;
  double distance2 = 0;  ///< r' S^-1 r
};

/// Of these the nearest first, as indices: each measurement and each landmark once.
std::vector<int> nearest_first(std::span<const Candidate> candidates);

/// r' S^-1 r of each pairing alone; infinite where S is not positive definite or a number is not finite.
std::vector<double> individual_distances(const AnyBelief& belief, std::span<const Pairing> pairings);

/// Of the pairings inside their own gate, the nearest first; each measurement and each landmark once.
Association nearest_neighbors(const AnyBelief& belief, std::span<const Pairing> pairings,
                              const AssociationSettings& settings);

/// The most pairings that are inside their own gates and inside the gate of all together; of sets as large
/// the one that is nearest.
Association jointly_compatible(const AnyBelief& belief, std::span<const Pairing> pairings,
                               const AssociationSettings& settings);

}  // namespace incognita
