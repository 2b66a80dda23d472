// What a run made of a place: how much of it was seen, and how soon landmarks were where one can say they
// are.
#pragma once

#include <cstdint>
#include <map>
#include <optional>

#include "incognita/record/snapshot/snapshot.hpp"

namespace incognita {

class ExplorationSummary {
 public:
  void add(const Snapshot& snapshot);

  /// Landmarks that were located: known to better than this share of how far away they were, thesis 6.3.1.
  static constexpr double located_ratio = 0.3;
  int located() const { return static_cast<int>(located_t_s_.size()); }
  /// When so many were, s; none when there were never so many.
  std::optional<double> located_t_s(int count) const;

  std::optional<double> coverage() const { return coverage_; }
  std::optional<double> entropy_extended() const { return entropy_extended_; }

 private:
  std::map<std::int64_t, double> located_t_s_;  ///< by landmark
  std::optional<double> coverage_, entropy_extended_;
};

}  // namespace incognita
