// The greatest accelerations of a path equal those of following it in small steps.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "incognita/control/paths/path_speed.hpp"

namespace incognita {
namespace {

PathAcceleration by_following(const Path& path, double until_s) {
  PathAcceleration most;
  for (double t = 0; t <= until_s; t += 1e-3) {
    const Reference r = at(path, t);
    most.m_s2 = std::max(most.m_s2, r.acceleration.cwiseAbs().maxCoeff());
    most.rad_s2 = std::max(most.rad_s2, std::abs(r.heading_acceleration));
  }
  return most;
}

std::vector<Path> paths() {
  PathSamples samples;
  for (int i = 0; i <= 20; ++i) {
    samples.t.push_back(i * (1 + 0.02 * i));
    samples.position.emplace_back(3 * std::sin(0.7 * i), 0.2 * i * i, std::cos(1.3 * i));
  }
  return {PointPath{{1, 2, 3}, 1}, CirclePath{.radius_m = 3, .rate_rad_s = -0.8},
          BackAndForthPath{.radius_m = 1.5, .amplitude_rad = 0.8},
          WayPointPath{{{0, 0, 0}, {1, 2, 0}, {1, 2, 0}, {-1, 2, 0.5}}, 0.7}, through(samples)};
}

TEST(PathAcceleration, EqualsThatOfSmallSteps) {
  for (const Path& path : paths()) {
    const PathAcceleration stated = greatest_acceleration(path), found = by_following(path, 300);
    EXPECT_NEAR(stated.m_s2, found.m_s2, 2e-3 * stated.m_s2) << path.index();
    EXPECT_NEAR(stated.rad_s2, found.rad_s2, 2e-3 * stated.rad_s2) << path.index();
    EXPECT_EQ(stated.m_s2 > 0, path.index() > 0);
  }
}

}  // namespace
}  // namespace incognita
