// Times of images that arrive.
#pragma once

namespace incognita {

/// s, on a clock of this machine that does not jump.
double steady_s();

/// The time of an image as the driver or the stream reports it, where that is plausible, else by its arrival.
class StreamTimes {
 public:
  /// s, increasing, in whole microseconds, from 0 at the first image. `reported_s`: on any clock, 0 where nothing is reported;
  /// not used if it goes back, or advances by a second more than the time between the arrivals. An image may arrive much later
  /// than it should, since a network holds images up and then gives them all at once; but a clock that gets five seconds away
  /// from the arrivals is wrong, and not used any more. `arrived_s`: of steady_s().
  double time_of(double reported_s, double arrived_s);
  /// The next image is the first of another connection, with another clock.
  void start_anew();

 private:
  bool is_plausible(double reported_s, double arrived_s) const;

  /// An image whose time was taken from its arrival, from which the reported times count on.
  struct Origin {
    double t = 0, reported_s = 0, arrived_s = 0;
  };
  bool is_first_ = true, is_related_ = false, is_trusted_ = true;
  Origin origin_, last_;
};

}  // namespace incognita
