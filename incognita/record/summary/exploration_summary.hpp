// Exploration progress of a run: coverage, and when landmarks became accurately located.
#pragma once

#include <cstdint>
#include <map>
#include <optional>

#include "incognita/record/snapshot/snapshot.hpp"

namespace incognita {

class ExplorationSummary {
 public:
  void add(const Snapshot& snapshot);

  /// A landmark is located once its largest sigma is below this share of its distance, thesis 6.3.1.
  static constexpr double located_ratio = 0.3;
  int located() const { return static_cast<int>(located_t_s_.size()); }
  /// Time at which `count` landmarks were located, s; nullopt if that never happened.
  std::optional<double> located_t_s(int count) const;

  std::optional<double> coverage() const { return coverage_; }
  std::optional<double> entropy_extended() const { return entropy_extended_; }

 private:
  std::map<std::int64_t, double> located_t_s_;  ///< by landmark
  std::optional<double> coverage_, entropy_extended_;
};

}  // namespace incognita
