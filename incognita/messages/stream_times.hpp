// Times of images that arrive.
#pragma once

namespace incognita {

/// s, on a clock of this machine that does not jump.
double steady_s();

/// The time of an image as the driver or the stream reports it, where that is plausible, else by its arrival.
class StreamTimes {
 public:
  /// s, increasing, in whole microseconds, from 0 at the first image. `reported_s`: on any clock, 0 where nothing is reported;
  /// not used if it goes back, or differs by more than a second from the time between the arrivals. `arrived_s`: of steady_s().
  double time_of(double reported_s, double arrived_s);

 private:
  bool is_first_ = true;
  double t_ = 0, reported_s_ = 0, arrived_s_ = 0;  ///< of the last image
};

}  // namespace incognita
