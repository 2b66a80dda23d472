// The camera on a plane of Figure 6.2, and what Section 6.1 claims of its information, by file.
//
// The camera stands at the origin, known to 0.2 m and 5 degrees, and measures bearings to 0.5 degrees within
// 90 degrees of its heading. Three landmarks: to its left, in front, and to the right of that; each known to
// 0.5 m. It may move 0.5 m in any direction with the same heading.
#pragma once

#include <numbers>
#include <vector>

#include "incognita/belief/any_belief.hpp"
#include "incognita/decision/information_gain.hpp"
#include "incognita/math/random.hpp"
#include "incognita/report/ledger.hpp"

namespace incognita::section_6_1_plane {

inline constexpr double sigma_bearing = 0.5 * std::numbers::pi / 180;

struct Plane {
  AnyBelief belief;
  BlockId camera = 0;
  std::vector<Eigen::Vector2d> points;
  std::vector<BlockId> blocks;

  Plane() : Plane({{0.3, 1.8}, {2.2, 0.3}, {1.7, -1.4}}) {}
  explicit Plane(std::vector<Eigen::Vector2d> places);

  /// The covariance of a landmark, which then depends on nothing else.
  void know(std::size_t landmark, const Eigen::Matrix2d& covariance);
  /// With the camera at that position, measurements of all landmarks in view.
  ImaginedStep step_to(const Eigen::Vector2d& position) const;
  /// The information of the measurements after a step.
  InformationGain gain_of(const ImaginedStep& step) const;
  double gain_at(const Eigen::Vector2d& position) const { return gain_of(step_to(position)).of_state(); }
  /// Goes there and measures.
  void measure_at(const Eigen::Vector2d& position);
};

/// 0.5 m in a direction, degrees to the left.
Eigen::Vector2d way(double degrees);
inline double direction_of(const Eigen::Vector2d& p) {
  return std::atan2(p.y(), p.x()) * 180 / std::numbers::pi;
}

/// A layout like that of the figure, whose numbers are not printed.
Plane drawn_landmarks(RandomStream& random);
/// Measures from `measurements` places around until the landmarks are correlated.
void measure_often(Plane& plane, int measurements, RandomStream& random);

/// (6.7) and (6.8).
std::vector<Claim> fisher_claims();
/// Information gain against entropy, where actions are evaluated one after the other: Section 6.2.
std::vector<Claim> choice_claims(int seeds);
/// How that information changes while the camera measures, and what the eigenvalues of (6.8) show.
std::vector<Claim> surface_claims(int seeds);

}  // namespace incognita::section_6_1_plane
