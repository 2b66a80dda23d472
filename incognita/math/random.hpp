// Named, seeded random streams.
//
// Every consumer of randomness owns a stream named after what it draws. All streams follow from one seed, and
// additional draws from one never change another. Normal variates are computed here, because
// std::normal_distribution may differ between standard libraries.
#pragma once

#include <cstdint>
#include <random>
#include <string_view>

namespace incognita {

class StateArchive;

class RandomStream {
 public:
  RandomStream(std::uint64_t seed, std::string_view name);

  std::uint64_t bits() { return engine_(); }
  /// Uniform in [0, 1).
  double uniform();
  /// Uniform in [low, high).
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// Standard normal.
  double normal();
  /// Uniform integer in [0, count). Throws std::invalid_argument when count < 1.
  int below(int count);

  /// Saves or restores the whole stream: saved_state/.
  void state(StateArchive& archive);

 private:
  std::mt19937_64 engine_;
  double spare_ = 0;
  bool has_spare_ = false;
};

}  // namespace incognita
