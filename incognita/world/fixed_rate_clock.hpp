// Fixed-rate clock of a simulation, which runs as fast as the machine allows.
#pragma once

#include "incognita/world/world.hpp"

namespace incognita {

class FixedRateClock final : public Clock {
 public:
  /// Ticks at 0, 1/rate, ... before `duration_s`. Throws std::invalid_argument if either is not positive.
  FixedRateClock(double rate_hz, double duration_s);

  Tick next() override;
  void state(StateArchive& archive) override;
  std::int64_t expected_frames() const override { return frames_; }

 private:
  double rate_hz_;
  std::int64_t frames_;
  std::int64_t next_ = 0;
};

}  // namespace incognita
