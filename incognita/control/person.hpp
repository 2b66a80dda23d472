// A person who moves a camera by hand, as a screen says: late, not quite so far, and sometimes the wrong way.
// Thesis 6.3.2.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <deque>
#include <string>

#include "incognita/control/settings.hpp"
#include "incognita/math/random.hpp"

namespace incognita {

/// From where to where, world, m, and when, s.
struct Way {
  Eigen::Vector3d from{0, 0, 0}, to{0, 0, 0};
  double start_t = 0, end_t = 0;
};

class Person {
 public:
  /// `name`: of the random stream. Throws std::invalid_argument where the settings can not be.
  Person(const PersonSettings& settings, std::uint64_t seed, const std::string& name);

  /// What is being done at `t`. `shown`: what the screen says, `is_new` when it says so since this tick; a
  /// person knows which way and how far, not the place, and begins where the camera is, `at`. What was shown
  /// later takes the place of what is still being done.
  const Way& obey(const Way& shown, bool is_new, const Eigen::Vector3d& at, double t);

  /// What was shown and not begun, and what was being done: the screen went dark.
  void forget();

 private:
  Eigen::Vector3d understood(const Eigen::Vector3d& way);

  PersonSettings settings_;
  RandomStream random_;
  std::deque<Way> seen_;  ///< shown, and not begun
  Way doing_;
  bool started_ = false;
};

}  // namespace incognita
