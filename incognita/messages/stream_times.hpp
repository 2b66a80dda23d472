// Times of images that arrive.
#pragma once

namespace incognita {

/// The time of an image from that which the driver or the stream tells, where it tells a plausible one, else from its arrival.
class StreamTimes {
 public:
  /// s, increasing, in whole microseconds, from 0 at the first image. `told_s`: 0 where nothing is told. Times that go back, or
  /// that differ by more than a second from what has passed, are not believed.
  double time_of(double told_s, double arrived_s);

 private:
  bool is_first_ = true;
  double t_ = 0, told_s_ = 0, arrived_s_ = 0;  ///< of the last image
};

}  // namespace incognita
