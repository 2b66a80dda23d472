// The frames that a camera misses, at ticks that may be more frequent than its images.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

namespace incognita {

class StateArchive;

class FrameCounter {
 public:
  /// To be called at each tick, at time `t`, s.
  void update(bool has_image, double t);

  /// Frames since the last image that are overdue by the period of the last images, as of a camera that failed; nothing
  /// before the first image. An image is overdue a quarter of a period after its time.
  std::optional<int> missed() const { return missed_; }

  /// Saves or restores: math/saved_state/.
  void state(StateArchive& archive);

 private:
  double period_s() const;

  std::optional<double> image_t_;      ///< s, of the last image
  std::array<double, 5> intervals_{};  ///< s, the last ones between two images
  std::size_t interval_count_ = 0;     ///< since the first image
  std::optional<int> missed_;
};

}  // namespace incognita
